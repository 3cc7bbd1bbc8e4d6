// Hexahedra and wedges, also in one region: patch tests on distorted meshes, rank, derivatives, orders of frequencies,
// plates, rows with hourglass shapes, and finer elements.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <cmath>
#include <numbers>

#include "lib/mesh/box.h"
#include "lib/mesh/quadratic.h"
#include "lib/mesh/refine.h"
#include "lib/mesh/selection.h"
#include "lib/simulation/error_estimate/finer_model.h"
#include "lib/simulation/preflight/input_checks/input_checks.h"
#include "lib/study/converge/richardson.h"
#include "tests/problems/running.h"

namespace orthodyn::hexahedra_test {
namespace {

const std::string kWood =
    "{type: orthotropic, density: 1, young: [10, 1, 0.5], nu12: 0.4, nu23: 0.4, nu31: 0.02, g12: 0.7, g23: 0.1, g13: "
    "0.6}";

enum class Cut { none, half, all };         // cells that are divided into two wedges
enum class Nodes { corners, edges, full };  // full: also in the middle of quadrilaterals and hexahedra

struct Kind {
  const char* name;
  Cut cut;
  Nodes nodes;
  bool is_linear() const { return nodes == Nodes::corners; }
};

constexpr Kind kKinds[] = {{"hex8", Cut::none, Nodes::corners},        {"hex20", Cut::none, Nodes::edges},
                           {"hex27", Cut::none, Nodes::full},          {"wedge6", Cut::all, Nodes::corners},
                           {"wedge15", Cut::all, Nodes::edges},        {"wedge18", Cut::all, Nodes::full},
                           {"hex8_wedge6", Cut::half, Nodes::corners}, {"hex20_wedge15", Cut::half, Nodes::edges},
                           {"hex27_wedge18", Cut::half, Nodes::full}};

// Divides each second column of hexahedra along z into wedges.
void cut_columns(Mesh& mesh, int along_x, int along_y) {
  Cells cells;
  for (int c = 0; c < static_cast<int>(mesh.cells.size()); ++c) {
    const auto n = mesh.cells[static_cast<std::size_t>(c)];
    if ((c % along_x + c / along_x % along_y) % 2 == 0) {
      cells.add(CellShape::hex8, n);
      continue;
    }
    cells.add(CellShape::wedge6, std::array{n[0], n[1], n[2], n[4], n[5], n[6]});
    cells.add(CellShape::wedge6, std::array{n[0], n[2], n[3], n[4], n[6], n[7]});
  }
  mesh.cells = std::move(cells);
  mesh.region_of.assign(mesh.cells.size(), 0);
  mesh.surfaces.erase("z0");  // of quadrilaterals
  mesh.surfaces.erase("z1");
}

// A box of `cells`, with its corners moved by `move` before edges get their middles.
template <class Move>
Mesh mesh_of(const Kind& kind, std::array<int, 3> cells, const Vec3& size, const Move& move) {
  const auto elements = kind.cut == Cut::all ? BoxMesh::Elements::wedges : BoxMesh::Elements::hexahedra;
  Mesh mesh = make_box({.size = size, .cells = cells, .elements = elements});
  if (kind.cut == Cut::half) cut_columns(mesh, cells[0], cells[1]);
  for (Vec3& x : mesh.nodes) x = move(x);
  if (kind.nodes != Nodes::corners) make_quadratic(mesh);
  if (kind.nodes == Nodes::full) add_centres(mesh);
  validate(mesh, {"box"});
  return mesh;
}

bool is_inner(const Vec3& x) { return (x.array() > 1e-9).all() && (x.array() < 1 - 1e-9).all(); }

Mesh distorted(const Kind& kind) {
  Random random(601);
  return mesh_of(kind, {3, 3, 3}, Vec3::Ones(),
                 [&](const Vec3& x) { return is_inner(x) ? Vec3(x + 0.05 * random.vector()) : x; });
}

BuiltTestScene scene_of(const Mesh& mesh, const std::string& more, const std::string& material = kWood) {
  given_mesh() = mesh;
  return BuiltTestScene(fmt::format(
      "mesh: {{type: given}}\nmaterials: {{m: {}}}\nregions: {{body: {{material: m, axes: {}}}}}\ntime: {{end: 1}}\n{}",
      material, kTurnedAxes, more));
}

class Solid : public testing::TestWithParam<Kind> {};
INSTANTIATE_TEST_SUITE_P(Kind, Solid, testing::ValuesIn(kKinds), [](const auto& one) { return one.param.name; });

TEST_P(Solid, PassesThePatchTestOfALinearDisplacement) {
  Random random(602);
  const Mat3 A = random.matrix();
  const BuiltTestScene s = scene_of(distorted(GetParam()), "elasticity: {kinematics: linear}");
  const Vector q = s.dofs([&](const Vec3& x) { return Vec3(A * x); });
  const NodalVector f = s.nodal(s.force(q));
  for (Eigen::Index n = 0; n < f.cols(); ++n)
    if (is_inner(s.model().parts().rest->col(n))) {
      EXPECT_LE(f.col(n).norm(), 1e-13);
    }
  const auto stress = s.model().evaluate("stress", {0, q, s.zero()});
  for (std::size_t k = 6; k < stress.size(); ++k) EXPECT_NEAR(stress[k], stress[k % 6], 1e-12);
}

// Wedges below z = 1, and on their triangles there tetrahedra up to one node.
Mesh wedges_and_tetrahedra(bool is_linear) {
  Mesh mesh = make_box({.size = Vec3::Ones(), .cells = {3, 3, 2}, .elements = BoxMesh::Elements::wedges});
  const auto apex = static_cast<int>(mesh.nodes.size());
  mesh.nodes.emplace_back(0.5, 0.5, 1.6);
  const auto wedges = mesh.cells.size();
  for (std::size_t c = 0; c < wedges; ++c) {
    const auto n = mesh.cells[c];
    if (mesh.nodes[static_cast<std::size_t>(n[3])][2] < 1 - 1e-9) continue;
    mesh.cells.add(CellShape::tet4, std::array{n[3], n[4], n[5], apex});
  }
  mesh.region_of.assign(mesh.cells.size(), 0);
  mesh.surfaces.clear();
  if (!is_linear) make_quadratic(mesh);
  validate(mesh, {"wedges and tetrahedra"});
  return mesh;
}

TEST(WedgesAndTetrahedra, PassThePatchTestOfALinearDisplacement) {
  Random random(612);
  const Mat3 A = random.matrix();
  for (const bool is_linear : {true, false}) {
    const BuiltTestScene s = scene_of(wedges_and_tetrahedra(is_linear), "elasticity: {kinematics: linear}");
    const Vector q = s.dofs([&](const Vec3& x) { return Vec3(A * x); });
    const NodalVector f = s.nodal(s.force(q));
    int on_the_interface = 0;
    for (Eigen::Index n = 0; n < f.cols(); ++n) {
      const Vec3 x = s.model().parts().rest->col(n);
      const bool is_within = (x.head<2>().array() > 1e-9).all() && (x.head<2>().array() < 1 - 1e-9).all();
      if (!is_within || std::abs(x[2] - 1) > 1e-9) continue;
      ++on_the_interface;
      EXPECT_LE(f.col(n).norm(), 1e-13);
    }
    EXPECT_GE(on_the_interface, 4);
  }
}

// Displacement with the strain z e. The stress z C e is in equilibrium if C e has no component along z.
Vec3 bent(const Vec3& x, const Mat3& e) { return x[2] * (e * x) - 0.5 * x.dot(e * x) * Vec3::UnitZ(); }

// The strain of a uniaxial stress of 1 Pa along x, in global axes.
Mat3 strain_of_stress_along_x(const BuiltTestScene& s) {
  const ElasticTerm& term = *s.model().parts().elastic[0];
  const Mat6 K = stress_rotation(term.axes_at_rest(0, 0)), C = K * term.stiffness() * K.transpose();
  const Eigen::Matrix<double, 6, 1> e = C.inverse().col(0);
  Mat3 strain;
  strain << e[0], e[3] / 2, e[5] / 2, e[3] / 2, e[1], e[4] / 2, e[5] / 2, e[4] / 2, e[2];
  return strain;
}

// A constant curvature has no force at inner nodes and the right energy, in both formulations. Elements with nodes in
// the middle of their faces pass on distorted cells, those with nodes on edges only on parallelepipeds.
TEST_P(Solid, PassesThePatchTestOfAConstantCurvature) {
  if (GetParam().is_linear()) return;
  const double shear = GetParam().nodes == Nodes::full ? 0 : 0.2;
  const auto sheared = [&](const Vec3& x) { return Vec3(x[0] + shear * x[1], x[1], x[2] + shear * x[0]); };
  const auto unsheared = [&](const Vec3& x) {
    const double x0 = x[0] - shear * x[1];
    return Vec3(x0, x[1], x[2] - shear * x0);
  };
  given_mesh() = shear == 0 ? distorted(GetParam()) : mesh_of(GetParam(), {3, 3, 3}, Vec3::Ones(), sheared);
  for (const char* formulation : {"displacement", "mixed"}) {
    if (formulation == std::string("mixed") && GetParam().cut != Cut::none) continue;
    SCOPED_TRACE(formulation);
    const BuiltTestScene s(fmt::format(
        "mesh: {{type: given}}\nmaterials: {{m: {}}}\nregions: {{body: {{material: m, axes: {}, formulation: {}}}}}\n"
        "elasticity: {{kinematics: linear}}\ntime: {{end: 1}}\n",
        kWood, kTurnedAxes, formulation));
    const Mat3 strain = strain_of_stress_along_x(s);
    const Vector q = s.dofs([&](const Vec3& x) { return bent(x, strain); });
    const NodalVector f = s.nodal(s.force(q));
    for (Eigen::Index n = 0; n < f.cols(); ++n)
      if (is_inner(unsheared(s.model().parts().rest->col(n)))) {
        EXPECT_LE(f.col(n).norm(), 1e-13);
      }
    const double square_of_z = 1.0 / 3 + shear / 2 + shear * shear / 3;  // mean over the body
    EXPECT_NEAR(s.potential(q), 0.5 * strain(0, 0) * square_of_z, 1e-13);
  }
}

// The mesh has no gaps: its cells together have the volume of the box, 1 m^3.
TEST_P(Solid, FillsTheBoxAndHasItsMass) {
  const Mesh mesh = distorted(GetParam());
  double volume = 0;
  for (std::size_t c = 0; c < mesh.cells.size(); ++c) volume += cell_volume(mesh, c);
  EXPECT_NEAR(volume, 1, 1e-13);
  for (const char* mass : {"lumped", "consistent"}) {
    const BuiltTestScene s = scene_of(mesh, fmt::format("mass: {}", mass));
    EXPECT_NEAR(s.model().parts().mass->total(), 1, 1e-13);
    EXPECT_GT(s.model().parts().mass->nodal().minCoeff(), 0);
  }
}

TEST_P(Solid, MovesWithoutForceAsARigidBodyOnly) {
  const BuiltTestScene s = scene_of(mesh_of(GetParam(), {2, 2, 2}, Vec3::Ones(), [](const Vec3& x) { return x; }), "");
  const Eigen::VectorXd values = Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(s.stiffness(s.zero())).eigenvalues();
  EXPECT_LT(values.head<6>().cwiseAbs().maxCoeff(), 1e-12 * values[values.size() - 1]);
  EXPECT_GT(values[6], 1e-5 * values[values.size() - 1]);
  Random random(603);
  const Mat3 R = random.rotation();
  const Vector q = s.dofs([&](const Vec3& x) { return Vec3(R * x - x); });
  EXPECT_LT(s.force(q).norm(), 1e-12);
}

// The force is minus the derivative of the energy, and the stiffness minus the derivative of the force. Central
// differences have an error of order 2 in the step.
TEST_P(Solid, HasExactDerivatives) {
  const BuiltTestScene s = scene_of(distorted(GetParam()), "clamps: [{surface: x0}]");
  Random random(604);
  const Vector q = random_dofs(random, s.size(), 0.02), d = random_dofs(random, s.size(), 1);
  const Vector slope = -s.stiffness(q) * d;
  const auto error = [&](double h) {
    return ((s.force(q + h * d) - s.force(q - h * d)) / (2 * h) - slope).norm() / slope.norm();
  };
  EXPECT_NEAR(std::log2(error(2e-3) / error(1e-3)), 2, 0.2);
  const auto energy_error = [&](double h) {
    return std::abs((s.potential(q + h * d) - s.potential(q - h * d)) / (2 * h) + s.force(q).dot(d));
  };
  EXPECT_NEAR(std::log2(energy_error(4e-3) / energy_error(2e-3)), 2, 0.2);
}

// Lowest frequency of a bar that only moves along x, whose exact value is pi for a length, density and modulus of 1.
double bar_frequency(const Kind& kind, int cells, const char* mass) {
  const auto skewed = [](const Vec3& x) {
    const double bend = 0.15 * std::sin(std::numbers::pi * x[0]) * (x[1] / 0.25 - 0.5);
    return Vec3(x[0] + bend * std::sin(std::numbers::pi * x[0]), x[1], x[2]);
  };
  given_mesh() = mesh_of(kind, {cells, cells / 4, cells / 4}, Vec3(1, 0.25, 0.25), skewed);
  const BuiltTestScene s(fmt::format(
      "mesh: {{type: given}}\nmaterials: {{m: {{type: isotropic, density: 1, young: 1, nu: 0}}}}\nregions: {{body: "
      "{{material: m}}}}\nclamps: [{{box: {{min: [-1, -1, -1], max: [2, 1, 1]}}, components: [y, z]}}]\nmass: {}\n"
      "elasticity: {{kinematics: linear}}\ntime: {{end: 1}}\n",
      mass));
  const Eigen::MatrixXd K = s.stiffness(s.zero()), M = s.mass();
  const Eigen::VectorXd squares = Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::MatrixXd>(K, M).eigenvalues();
  return std::sqrt(squares[1]);
}

// Linear elements: of order two.
TEST_P(Solid, HasFrequenciesOfOrderFourWithAConsistentMass) {
  const auto error = [&](int cells) {
    return std::abs(bar_frequency(GetParam(), cells, "consistent") / std::numbers::pi - 1);
  };
  const double order = std::log2(error(4) / error(8)), expected = GetParam().is_linear() ? 2 : 4;
  EXPECT_GT(order, 0.8 * expected);
  EXPECT_LT(order, 1.2 * expected);
}

TEST_P(Solid, HasFrequenciesOfOrderTwoOrMoreWithALumpedMass) {
  const auto error = [&](int cells) {
    return std::abs(bar_frequency(GetParam(), cells, "lumped") / std::numbers::pi - 1);
  };
  EXPECT_LT(error(8), 2e-2);
  const double order = std::log2(error(4) / error(8));
  EXPECT_GT(order, 1.6);
  EXPECT_LT(order, 4.8);
}

// Coarse displacements are displacements of the finer mesh, too: the elastic energy of a state does not change.
TEST_P(Solid, IsASubspaceOfItsRefinement) {
  const auto sheared = [](const Vec3& x) { return Vec3(x[0] + 0.2 * x[1], x[1], x[2] + 0.1 * x[0]); };
  const BuiltTestScene s =
      scene_of(mesh_of(GetParam(), {2, 2, 1}, Vec3::Ones(), sheared), "clamps: [{surface: x0}]\nmass: consistent");
  const FinerModel finer(s.scene, s.model());
  Random random(605);
  const Vector q = random_dofs(random, s.size(), 0.01), fine = finer.lift(q), none = Vector::Zero(fine.size());
  EXPECT_EQ(finer.model().parts().mesh.cells.size(), (GetParam().is_linear() ? 1 : 8) * s.mesh().cells.size());
  Vector mass_of_fine(fine.size()), mass_of_coarse(q.size());
  finer.model().multiply_mass(fine, mass_of_fine);
  s.model().multiply_mass(q, mass_of_coarse);
  EXPECT_NEAR(fine.dot(mass_of_fine), q.dot(mass_of_coarse), 1e-12 * q.dot(mass_of_coarse));
}

std::vector<int> nodes_at_the_bottom(const Mesh& mesh) {
  std::vector<int> found;
  for (int n = 0; n < static_cast<int>(mesh.nodes.size()); ++n)
    if (std::abs(mesh.node(n)[2]) < 1e-12) found.push_back(n);
  return found;
}

TEST_P(Solid, KeepsItsShapeAndItsNodeSetsWhenRefined) {
  LoadedMesh loaded{.mesh = distorted(GetParam())};
  loaded.mesh.node_sets["bottom"] = nodes_at_the_bottom(loaded.mesh);
  const CellShape shape = loaded.mesh.cells.shape(0);
  const std::size_t faces = loaded.mesh.surfaces.at("x0").size();
  refine(loaded);
  validate(loaded.mesh, {"refined"});
  EXPECT_EQ(loaded.mesh.cells.shape(0), shape);
  EXPECT_EQ(loaded.mesh.surfaces.at("x0").size(), 4 * faces);
  EXPECT_EQ(loaded.mesh.node_sets.at("bottom"), nodes_at_the_bottom(loaded.mesh));
  double volume = 0;
  for (std::size_t c = 0; c < loaded.mesh.cells.size(); ++c) volume += cell_volume(loaded.mesh, c);
  EXPECT_NEAR(volume, 1, 1e-13);
}

// A uniform pressure on all faces, of either kind, gives a uniform pressure in the body.
TEST_P(Solid, IsPressedUniformly) {
  const BuiltTestScene s = scene_of(distorted(GetParam()), "terms: [{type: pressure, pressure: 1e-3, follows: false}]");
  const NodalVector f = s.nodal(s.force(s.zero()));
  EXPECT_LT(f.rowwise().sum().norm(), 1e-15);
  double work = 0;  // of the displacement x: -p times three volumes
  for (Eigen::Index n = 0; n < f.cols(); ++n) work += f.col(n).dot(s.model().parts().rest->col(n));
  EXPECT_NEAR(work, -3e-3, 1e-15);
}

std::string part_names_of(const Mesh& mesh) {
  const BuiltTestScene s = scene_of(mesh, "");
  std::string names;
  for (const auto& term : s.model().parts().elastic) names += term->region() + " ";
  return names;
}

TEST(RegionsOfSeveralKinds, HaveAPartForEachKind) {
  EXPECT_EQ(part_names_of(distorted(kKinds[1])), "body ");
  EXPECT_EQ(part_names_of(distorted(kKinds[7])), "body.wedges body.hexahedra ");
}

Config row_of(const std::string& cells, const std::string& integration = "auto") {
  return Config::from_text(fmt::format(
      "mesh: {{type: box, size: [1, 0.1, 0.1], cells: {}, elements: hexahedra}}\nmaterials: {{m: {{type: isotropic, "
      "density: 1000, young: 1 GPa, nu: 0}}}}\nregions: {{body: {{material: m, integration: {}}}}}\nclamps: "
      "[{{surface: x0}}]\nloads: [{{surface: x1, force: [0, 0, -1]}}]\nanalysis: static\n",
      cells, integration));
}

std::string warnings_of(const std::string& cells, const std::string& integration) {
  std::string all;
  for (const std::string& warning : scene_warnings(row_of(cells, integration))) all += warning + "\n";
  return all;
}

// A row that is one element wide and high has shapes without stiffness even if one end is held.
TEST(RowsOfHexahedra, OfOneElementAreToldToHaveHourglassShapesWithReducedIntegration) {
  EXPECT_NE(warnings_of("[10, 1, 1]", "reduced").find("10 hexahedra are without neighbours in two directions"),
            std::string::npos);
  EXPECT_EQ(warnings_of("[10, 2, 1]", "reduced").find("hourglass"), std::string::npos);
  EXPECT_EQ(warnings_of("[10, 1, 1]", "auto").find("hourglass"), std::string::npos);
}

TEST(RowsOfHexahedra, OfOneElementAreIntegratedFully) {
  const auto points = [](const std::string& cells, const std::string& integration) {
    return BuiltTestScene(row_of(cells, integration)).model().parts().elastic[0]->num_points();
  };
  EXPECT_EQ(points("[10, 1, 1]", "auto"), 14);
  EXPECT_EQ(points("[10, 2, 1]", "auto"), 8);
  EXPECT_EQ(points("[10, 2, 2]", "full"), 14);
  EXPECT_EQ(points("[10, 1, 1]", "reduced"), 8);
}

// F L^3 / (3 E I) and the shear F L / (G A 5/6): 4e-5 m and 2.4e-7 m.
TEST(RowsOfHexahedra, OfOneElementBendAsABeam) {
  const BuiltTestScene s(row_of("[20, 1, 1]"));
  EXPECT_NEAR(-s.nodal(linear_static(s))(2, nearest_node(s.mesh(), {1, 0.1, 0.1})), 4.024e-5, 4e-3 * 4.024e-5);
}

}  // namespace
}  // namespace orthodyn::hexahedra_test
