// Layered regions: plies through hexahedra and wedges, against regions of one material per cell, closed forms of beams
// and classical lamination theory.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "lib/mesh/box.h"
#include "lib/mesh/quadratic.h"
#include "lib/mesh/selection.h"
#include "lib/scene/quantity.h"
#include "lib/simulation/error_estimate/finer_model.h"
#include "lib/simulation/preflight/input_checks/input_checks.h"
#include "tests/fem/built_scene.h"

namespace orthodyn::layup_test {
namespace {

const std::string kMaterials =
    "materials:\n"
    "  stiff: {type: orthotropic, density: 2, young: [10, 1, 0.5], nu12: 0.4, nu23: 0.4, nu31: 0.02, g12: 0.7, g23: "
    "0.1, g13: 0.6, strength: {tension: [1, 0.1, 0.1], compression: [1, 0.1, 0.1], shear: [0.1, 0.1, 0.1]}}\n"
    "  soft: {type: isotropic, density: 1, young: 0.3, nu: 0.2}\n";

std::string box(const std::string& cells, const std::string& elements = "hexahedra",
                const std::string& size = "[1, 0.5, 0.2]") {
  return fmt::format("mesh: {{type: box, size: {}, cells: {}, elements: {}}}\n", size, cells, elements);
}

std::string region(const std::string& layup, const std::string& axes = "{first: [1, 0, 0], second: [0, 1, 0]}") {
  return fmt::format("regions: {{body: {{layup: {}, axes: {}}}}}\ntime: {{end: 1}}\n", layup, axes);
}

const std::string kThree = "[[stiff, 0, 0.05], [soft, 0, 0.1], [stiff, 60 deg, 0.05]]";

struct Layers {
  const char* name;
  BoxMesh::Elements elements;
  bool centres;
  int across;  // cells through the thickness
};

class Layered : public testing::TestWithParam<Layers> {
 protected:
  // A plate of 1 x 0.5 x 0.2 m whose inner nodes are moved in its plane.
  static BuiltTestScene plate(const std::string& more = "elasticity: {kinematics: linear}\n") {
    const Layers& layers = GetParam();
    Mesh mesh = make_box({.size = {1, 0.5, 0.2}, .cells = {3, 2, layers.across}, .elements = layers.elements});
    for (Vec3& x : mesh.nodes)
      if (x[0] > 0.1 && x[0] < 0.9 && x[1] > 0.1 && x[1] < 0.4) x += Vec3(0.04, -0.03, 0);
    make_quadratic(mesh);
    if (layers.centres) add_centres(mesh);
    validate(mesh, {"box"});
    given_mesh() = mesh;
    return BuiltTestScene("mesh: {type: given}\n" + kMaterials + region(kThree) + more);
  }
};
INSTANTIATE_TEST_SUITE_P(Cells, Layered,
                         testing::Values(Layers{"hex20", BoxMesh::Elements::hexahedra, false, 1},
                                         Layers{"hex20_two", BoxMesh::Elements::hexahedra, false, 2},
                                         Layers{"hex20_three", BoxMesh::Elements::hexahedra, false, 3},
                                         Layers{"hex27", BoxMesh::Elements::hexahedra, true, 1},
                                         Layers{"wedge15", BoxMesh::Elements::wedges, false, 1},
                                         Layers{"wedge15_two", BoxMesh::Elements::wedges, false, 2},
                                         Layers{"wedge18", BoxMesh::Elements::wedges, true, 1}),
                         [](const auto& one) { return one.param.name; });

const OrthotropicStiffness& stiff() {
  static const OrthotropicStiffness C =
      std::get<OrthotropicStiffness>(BuiltTestScene(box("[1, 1, 1]") + kMaterials + region("[[stiff, 0, 0.2]]"))
                                         .scene.materials[0]
                                         .second->stiffness());
  return C;
}

// The stress of ply 1 to 3 (Pa, in space) in a uniform strain e.
Mat3 stress_of_ply(int ply, const Mat3& e) {
  if (ply == 2) return isotropic_stiffness(0.3, 0.2).stress<double>(e);
  const Mat3 Q = Eigen::AngleAxisd(ply == 3 ? std::numbers::pi / 3 : 0, Vec3::UnitZ()).toRotationMatrix();
  return Q * stiff().stress<double>(Mat3(Q.transpose() * e * Q)) * Q.transpose();
}

// In a uniform strain, each ply stores its energy density times its volume. The number of cells across does not matter.
TEST_P(Layered, StoreTheEnergyOfTheirPliesInAUniformStrain) {
  Random random(701);
  const Mat3 A = random.matrix(), e = (A + A.transpose()) / 2;
  const BuiltTestScene s = plate();
  const Vector q = s.dofs([&](const Vec3& x) { return Vec3(A * x); });
  double expected = 0;
  for (const int ply : {1, 2, 3})
    expected += 0.5 * (ply == 2 ? 0.05 : 0.025) * stress_of_ply(ply, e).cwiseProduct(e).sum();
  EXPECT_NEAR(s.potential(q), expected, 1e-13 * expected);
  EXPECT_NEAR(s.model().parts().mass->total(), 0.025 * 2 + 0.05 * 1 + 0.025 * 2, 1e-15);
}

TEST_P(Layered, HaveTheStressOfEachPlyAtItsNodes) {
  Random random(702);
  const Mat3 A = random.matrix(), e = (A + A.transpose()) / 2;
  const BuiltTestScene s = plate();
  const Vector q = s.dofs([&](const Vec3& x) { return Vec3(A * x); });
  const auto expect_stress = [](const double* found, const Mat3& sigma, double tolerance) {
    const double expected[] = {sigma(0, 0), sigma(1, 1), sigma(2, 2), sigma(0, 1), sigma(1, 2), sigma(2, 0)};
    for (int i = 0; i < 6; ++i) EXPECT_NEAR(found[i], expected[i], tolerance) << i;
  };
  const auto bottom = static_cast<std::size_t>(nearest_node(s.mesh(), {0, 0, 0}));
  const auto top = static_cast<std::size_t>(nearest_node(s.mesh(), {0, 0, 0.2}));
  const auto of_ply_1 = s.model().evaluate("body.ply_1.nodal_stress", {0, q, s.zero()});
  expect_stress(of_ply_1.data() + 6 * bottom, stress_of_ply(1, e), 1e-11);
  if (GetParam().across == 1) {  // a cell's top node has the top of each of its plies
    expect_stress(of_ply_1.data() + 6 * top, stress_of_ply(1, e), 1e-11);
  }
  const auto of_all = s.model().evaluate("nodal_stress", {0, q, s.zero()});
  expect_stress(of_all.data() + 6 * bottom, stress_of_ply(1, e), 1e-11);
  expect_stress(of_all.data() + 6 * top, stress_of_ply(3, e), 1e-11);
}

// Bent about y with the strain e_xx = z - z_0: ply 1 has the stress c11 e_xx at its bottom, middle and top, which a
// cell lists at its own bottom, middle and top.
TEST_P(Layered, HaveTheStressOfABentPlyAtItsHeights) {
  if (GetParam().across > 1) GTEST_SKIP() << "a ply may have several parts";
  const BuiltTestScene s = plate();
  const Vector q = s.dofs([](const Vec3& x) { return Vec3(x[0] * (x[2] - 0.1), 0, -x[0] * x[0] / 2); });
  const auto stress = s.model().evaluate("body.ply_1.nodal_stress", {0, q, s.zero()});
  const auto at = [&](double z) { return stress[6 * static_cast<std::size_t>(nearest_node(s.mesh(), {0, 0, z}))]; };
  const double c11 = stiff().c11;
  EXPECT_NEAR(at(0), c11 * (0 - 0.1), 1e-11);
  EXPECT_NEAR(at(0.1), c11 * (0.025 - 0.1), 1e-11);
  EXPECT_NEAR(at(0.2), c11 * (0.05 - 0.1), 1e-11);
}

TEST_P(Layered, HaveAForceThatIsTheGradientOfTheirEnergy) {
  Random random(703);
  const BuiltTestScene s = plate("");
  const Vector q = random_dofs(random, s.size(), 0.01), d = random_dofs(random, s.size(), 1);
  const double slope = -s.force(q).dot(d);
  const auto error = [&](double h) {
    return std::abs((s.potential(q + h * d) - s.potential(q - h * d)) / (2 * h) - slope);
  };
  EXPECT_LT(error(1e-4), 1e-4 * s.force(q).norm());
  EXPECT_NEAR(error(2e-4) / error(1e-4), 4, 0.2);  // second order
  const Vector K_d = s.stiffness(q) * d;
  EXPECT_LT((K_d + (s.force(q + 1e-5 * d) - s.force(q - 1e-5 * d)) / 2e-5).norm(), 1e-5 * K_d.norm());
}

// One ply per cell is the same as one region per layer of cells.
TEST(Plies, OfWholeCellsAreRegions) {
  const std::string parts =
      "mesh: {type: box, size: [1, 0.5, 0.3], cells: [3, 2, 3], elements: hexahedra, parts: {middle: {min: [0, 0, "
      "0.1], max: [1, 1, 0.2]}, top: {min: [0, 0, 0.2], max: [1, 1, 0.3]}}}\n";
  const BuiltTestScene regions(parts + kMaterials +
                               "regions:\n"
                               "  body: {material: stiff}\n"
                               "  middle: {material: soft}\n"
                               "  top: {material: stiff, axes: {first: [0, 1, 0], second: [-1, 0, 0]}}\n"
                               "time: {end: 1}\n");
  const BuiltTestScene plies(box("[3, 2, 3]", "hexahedra", "[1, 0.5, 0.3]") + kMaterials +
                             region("[[stiff, 0, 0.1], [soft, 0, 0.1], [stiff, 90 deg, 0.1]]"));
  Random random(704);
  const Vector q = random_dofs(random, plies.size(), 0.01);
  EXPECT_LE((plies.stiffness(q) - regions.stiffness(q)).norm(), 1e-13 * regions.stiffness(q).norm());
  EXPECT_LE((plies.force(q) - regions.force(q)).norm(), 1e-13 * regions.force(q).norm());
  EXPECT_LE((plies.mass() - regions.mass()).norm(), 1e-14 * regions.mass().norm());
}

// The numbering of a cell does not matter, nor its sense along axis 3.
TEST(Plies, AreStackedAlongAxisThreeInCellsOfAnyNumbering) {
  const BuiltTestScene expected(box("[2, 2, 1]") + kMaterials + region(kThree));
  Mesh mesh = make_box({.size = {1, 0.5, 0.2}, .cells = {2, 2, 1}, .elements = BoxMesh::Elements::hexahedra});
  // Three turns of a hexahedron: about a diagonal, upside down, and both.
  const std::array<std::array<std::size_t, 8>, 3> turns{
      {{0, 4, 5, 1, 3, 7, 6, 2}, {4, 7, 6, 5, 0, 3, 2, 1}, {3, 2, 6, 7, 0, 1, 5, 4}}};
  for (std::size_t cell = 0; cell < turns.size(); ++cell) {
    const auto nodes = mesh.cells.nodes_of(cell);
    const std::vector<int> before(nodes.begin(), nodes.end());
    for (std::size_t a = 0; a < 8; ++a) nodes[a] = before[turns[cell][a]];
  }
  make_quadratic(mesh);
  validate(mesh, {"turned"});
  given_mesh() = mesh;
  const BuiltTestScene turned("mesh: {type: given}\n" + kMaterials + region(kThree));
  Random random(705);
  const Mat3 A = 0.1 * random.matrix(), B = 0.1 * random.matrix();
  const auto bent = [&](const Vec3& x) { return Vec3(A * x + x[2] * (B * x)); };
  const double energy = expected.potential(expected.dofs(bent));
  EXPECT_NEAR(turned.potential(turned.dofs(bent)), energy, 1e-13 * energy);
}

// Elements of half the size have the plies that lie in them. In a bent body their heights matter.
TEST(Plies, StayWhereTheyAreInFinerElements) {
  const BuiltTestScene s(box("[2, 2, 1]") + kMaterials + region(kThree) + "elasticity: {kinematics: linear}\n");
  const FinerModel finer(s.scene, s.model());
  Random random(706);
  const Mat3 A = random.matrix(), B = random.matrix();
  const Vector q = s.dofs([&](const Vec3& x) { return Vec3(A * x + x[2] * (B * x)); });
  const Vector still = Vector::Zero(finer.model().num_dofs());
  const double energy = finer.model().evaluate("energy.elastic", {0, finer.lift(q), still})[0];
  EXPECT_NEAR(energy, s.potential(q), 1e-13 * energy);
}

// Stiffnesses of a strip of plies without Poisson's effect, per width, about the bottom: the integrals of E, E z, E
// z^2.
struct StripStiffness {
  double a = 0, b = 0, d = 0;
  void add(double young, double bottom, double top) {
    a += young * (top - bottom);
    b += young * (top * top - bottom * bottom) / 2;
    d += young * (top * top * top - bottom * bottom * bottom) / 3;
  }
};

const std::string kStrip =
    "mesh: {type: box, size: [1, 0.1, 0.01], cells: [20, 2, 1], elements: hexahedra}\n"
    "materials:\n"
    "  hard: {type: isotropic, density: 1, young: 10e9, nu: 0}\n"
    "  soft: {type: isotropic, density: 1, young: 1e9, nu: 0}\n"
    "elasticity: {kinematics: linear}\n";

// A strip of a hard and a soft ply, pulled at its middle height: it bends, because the hard ply stretches less.
TEST(Plies, ThatDifferBendUnderTension) {
  const BuiltTestScene s(kStrip + region("[[hard, 0, 0.004], [soft, 0, 0.006]]") +
                         "clamps: [{surface: x0, components: [x]}, {nearest: [0, 0.05, 0], components: [y, z]}, "
                         "{nearest: [0, 0.1, 0], components: [z]}]\n"
                         "loads: [{surface: x1, traction: [1e6, 0, 0]}]\n");
  StripStiffness strip;
  strip.add(10e9, 0, 0.004);
  strip.add(1e9, 0.004, 0.01);
  // Force 1e4 N/m at height 0.005: [a b; b d] (strain at the bottom, curvature) = 1e4 (1, 0.005).
  const Eigen::Matrix2d K = (Eigen::Matrix2d() << strip.a, strip.b, strip.b, strip.d).finished();
  const Eigen::Vector2d response = K.inverse() * Eigen::Vector2d(1e4, 50);
  const NodalVector u = s.nodal(linear_static(s));
  const int end = nearest_node(s.mesh(), {1, 0.05, 0});
  EXPECT_NEAR(u(0, end), response[0], 2e-3 * std::abs(response[0]));
  EXPECT_NEAR(u(2, end), -response[1] / 2, 2e-3 * std::abs(response[1] / 2));
}

// A cantilever of seven plies bends by F L^3 / (3 E I), also with few cells; shear adds 1e-4.
TEST(Plies, BendWithTheSumOfTheirStiffnesses) {
  const BuiltTestScene s(kStrip +
                         region("[[hard, 0, 0.001], [soft, 0, 0.002], [hard, 0, 0.001], [soft, 0, 0.002], [hard, 0, "
                                "0.001], [soft, 0, 0.002], [hard, 0, 0.001]]") +
                         "clamps: [{surface: x0}]\nloads: [{surface: x1, force: [0, 0, 1]}]\n");
  StripStiffness strip;
  double bottom = -0.005;
  for (const auto& [young, thickness] : {std::pair{10e9, 0.001},
                                         {1e9, 0.002},
                                         {10e9, 0.001},
                                         {1e9, 0.002},
                                         {10e9, 0.001},
                                         {1e9, 0.002},
                                         {10e9, 0.001}}) {
    strip.add(young, bottom, bottom + thickness);
    bottom += thickness;
  }
  const double expected = 1 / (3 * 0.1 * strip.d);
  const double tip = s.nodal(linear_static(s))(2, nearest_node(s.mesh(), {1, 0.05, 0.01}));
  EXPECT_NEAR(tip, expected, 1e-3 * expected);
}

// Reduced stiffness of a ply in plane stress, turned by theta: order 11, 22, 12 with engineering shear.
Eigen::Matrix3d reduced_stiffness(double theta) {
  const double E1 = 100, E2 = 10, nu = 0.3, G = 5, n = 1 - nu * nu * E2 / E1;
  Eigen::Matrix3d Q;
  Q << E1 / n, nu * E2 / n, 0, nu * E2 / n, E2 / n, 0, 0, 0, G;
  const double c = std::cos(theta), s = std::sin(theta);
  Eigen::Matrix3d T;  // strains in the ply's axes
  T << c * c, s * s, c * s, s * s, c * c, -c * s, -2 * c * s, 2 * c * s, c * c - s * s;
  return T.transpose() * Q * T;
}

// Two plies at plus and minus theta, free but for rigid motions, and pulled: they twist. Classical lamination theory
// gives the curvature far from the edges; edges are within one thickness, 1/100 of the width.
TEST(Plies, AtOppositeAnglesTwistUnderTensionAsLaminationTheorySays) {
  const double theta = std::numbers::pi / 6, t = 0.005;
  const BuiltTestScene s(fmt::format(R"(
mesh: {{type: box, size: [2, 1, 0.01], cells: [24, 12, 1], elements: hexahedra}}
materials:
  ply: {{type: orthotropic, density: 1, young: [100, 10, 10], nu12: 0.3, nu13: 0.3, nu23: 0.3, g12: 5, g13: 5, g23: 4}}
regions: {{body: {{layup: [[ply, 30 deg, {0}], [ply, -30 deg, {0}]]}}}}
elasticity: {{kinematics: linear}}
clamps: [{{nearest: [1, 0.5, 0]}}, {{nearest: [1.08333333, 0.5, 0], components: [y, z]}},
         {{nearest: [1, 0.5833333, 0], components: [z]}}]
loads: [{{surface: x0, traction: [-1e-3, 0, 0]}}, {{surface: x1, traction: [1e-3, 0, 0]}}]
time: {{end: 1}}
)",
                                     t));
  Eigen::Matrix<double, 6, 6> ABD = Eigen::Matrix<double, 6, 6>::Zero();
  for (const auto& [angle, bottom] : {std::pair{theta, -t}, {-theta, 0.0}}) {
    const Eigen::Matrix3d Q = reduced_stiffness(angle);
    const double top = bottom + t;
    ABD.topLeftCorner<3, 3>() += Q * (top - bottom);
    const Eigen::Matrix3d B = Q * (top * top - bottom * bottom) / 2;
    ABD.topRightCorner<3, 3>() += B;
    ABD.bottomLeftCorner<3, 3>() += B;
    ABD.bottomRightCorner<3, 3>() += Q * (std::pow(top, 3) - std::pow(bottom, 3)) / 3;
  }
  Vec6 load = Vec6::Zero();
  load[0] = 1e-3 * 2 * t;
  const Vec6 response = ABD.inverse() * load;  // strains, then -d2w/dx2, -d2w/dy2, -2 d2w/dxdy
  const NodalVector u = s.nodal(linear_static(s));
  const auto at = [&](double x, double y) -> Vec3 { return u.col(nearest_node(s.mesh(), {x, y, 0})); };
  const double dx = 0.5, dy = 0.25;
  const double twist =
      (at(1 + dx, 0.5 + dy)[2] - at(1 - dx, 0.5 + dy)[2] - at(1 + dx, 0.5 - dy)[2] + at(1 - dx, 0.5 - dy)[2]) /
      (4 * dx * dy);
  EXPECT_NEAR(twist, -response[5] / 2, 0.01 * std::abs(response[5] / 2));
  EXPECT_GT(std::abs(response[5]) * t, 0.3 * response[0]);  // a large effect
  EXPECT_NEAR((at(1 + dx, 0.5)[0] - at(1 - dx, 0.5)[0]) / (2 * dx), response[0], 0.01 * response[0]);
}

// A clamped strip under pressure: its moment is quadratic in x, so that wide patches would smooth it. The stress at the
// lower side in the middle is 6 (p L^2/24)/t^2.
TEST(Plies, AndBodiesOfOneCellHaveTheBendingStressOfACurvedMoment) {
  const std::string strip =
      "mesh: {type: box, size: [0.3, 0.1, 0.003], cells: [16, 2, 1], elements: hexahedra}\n"
      "materials: {m: {type: isotropic, density: 1, young: 1e9, nu: 0}}\n"
      "elasticity: {kinematics: linear}\nclamps: [{surface: x0}, {surface: x1}]\n"
      "loads: [{surface: z1, traction: [0, 0, -300]}]\ntime: {end: 1}\n";
  const double expected = 6 * (300 * 0.09 / 24) / (0.003 * 0.003);
  for (const std::string region : {"", "regions: {body: {layup: [[m, 0, 1 mm], [m, 0, 2 mm]]}}\n"}) {
    const BuiltTestScene s(strip + region);
    const auto stress = s.model().evaluate("nodal_stress", {0, linear_static(s), s.zero()});
    const auto middle = static_cast<std::size_t>(nearest_node(s.mesh(), {0.15, 0.05, 0}));
    EXPECT_NEAR(stress[6 * middle], expected, 0.04 * expected) << region;
  }
}

TEST(Plies, HaveExtremesOfAllTheirParts) {
  const BuiltTestScene s(box("[2, 2, 2]") + kMaterials + region(kThree) + "elasticity: {kinematics: linear}\n");
  const Vector q = s.dofs([](const Vec3& x) { return Vec3(x[0] * (x[2] - 0.1), 0, -x[0] * x[0] / 2); });
  const State state{0, q, s.zero()};
  ASSERT_EQ(s.model().parts().elastic.size(), 4u);
  EXPECT_EQ(s.model().parts().elastic[1]->region(), "body.ply_2_1");
  const auto largest = [&](const std::string& name) {
    const auto find = find_extreme(name + ".nodal_stress.xx.largest", s.model(), {});
    return find ? (*find)(ObservedState(s.model(), state)).value : std::nan("");
  };
  const double of_soft = isotropic_stiffness(0.3, 0.2).stress<double>(Mat3(Vec3(0.05, 0, 0).asDiagonal()))(0, 0);
  EXPECT_NEAR(largest("body.ply_2"), of_soft, 1e-11);
  EXPECT_NEAR(largest("body.ply_2_1"), 0, 1e-11);
  EXPECT_NEAR(largest("body.ply_2_2"), of_soft, 1e-11);
  EXPECT_GT(largest("body"), of_soft);
}

// Fields can be asked for by the name of a ply, also if the mesh divides the ply into several parts.
TEST(Plies, HaveFieldsByTheirNameOnEachMesh) {
  const auto bent = [](const Vec3& x) { return Vec3(x[0] * (x[2] - 0.1), 0, -x[0] * x[0] / 2); };
  for (const char* cells : {"[2, 2, 1]", "[2, 2, 2]", "[2, 2, 4]"}) {
    const BuiltTestScene s(box(cells) + kMaterials + region(kThree) + "elasticity: {kinematics: linear}\n");
    const State state{0, s.dofs(bent), s.zero()};
    const auto fields = s.model().outputs();
    EXPECT_TRUE(std::ranges::any_of(fields, [](const auto& f) { return f.name == "body.ply_2.nodal_strain"; }));
    const auto strain = s.model().evaluate("body.ply_2.nodal_strain", state);
    const int middle = nearest_node(s.mesh(), {0.5, 0.25, 0.1}), above = nearest_node(s.mesh(), {0.5, 0.25, 0.15});
    EXPECT_NEAR(strain[6 * static_cast<std::size_t>(middle)], 0, 1e-12) << cells;
    EXPECT_NEAR(s.model().view(state)->evaluate_at("body.ply_2.nodal_strain", middle, 6)[0], 0, 1e-12) << cells;
    if (cells == std::string("[2, 2, 4]")) {  // a node at the top of the ply
      EXPECT_NEAR(strain[6 * static_cast<std::size_t>(above)], 0.05, 1e-12);
    }
    EXPECT_EQ(s.model().evaluate("body.ply_2.von_mises", state).size(), s.mesh().nodes.size());
    EXPECT_NO_THROW(FinerModel(s.scene, s.model()).model().outputs());
  }
}

std::string layer_warning(const std::string& cells, const std::string& size, const std::string& layup) {
  const Config scene = Config::from_text(box(cells, "hexahedra", size) + kMaterials + region(layup) +
                                             "clamps: [{surface: x0}, {surface: x1}]\ngravity: [0, 0, -1]\n",
                                         "scene.yaml");
  for (const std::string& warning : scene_warnings(scene))
    if (warning.find("transverse shear") != std::string::npos) return warning;
  return "";
}

// The missing shear over the bending of a clamped span is r = (2 pi H / L)^2 / 12 E (1/G - 1/G'). Along x E is
// 10 * 7/8 + 0.3 / 8 = 8.79. The soft half of the thickness has 0.952 of the 1.2 of the squared shear stress, so that
// 1/G = 0.952 / 0.125 + 0.248 / 0.6 = 8.03 and 1/G' = 1.2 / (0.5 * 0.6 + 0.5 * 0.125) = 3.31: r = 0.218, the deflection
// is r / (1 + r) = 18 % too small and the frequency sqrt(1 + r) - 1 = 10 % too high, also with a half of each soft ply
// in each of two cells.
TEST(Plies, ThatShareACellAreToldIfTheyDifferInShear) {
  const std::string three = "[[stiff, 0, 0.01], [soft, 0, 0.02], [stiff, 0, 0.01]]";
  for (const char* cells : {"[8, 4, 1]", "[8, 4, 2]"}) {
    const std::string found = layer_warning(cells, "[1, 0.5, 0.04]", three);
    EXPECT_NE(found.find("about 18 % too small and frequencies 10 % too high"), std::string::npos) << found;
  }
  const std::string turned =
      layer_warning("[4, 8, 1]", "[0.5, 1, 0.04]", "[[stiff, 90 deg, 0.01], [soft, 0, 0.02], [stiff, 90 deg, 0.01]]");
  EXPECT_NE(turned.find("about 18 % too small"), std::string::npos) << turned;
  EXPECT_EQ(layer_warning("[8, 4, 4]", "[1, 0.5, 0.04]", three), "");
  EXPECT_EQ(layer_warning("[8, 4, 1]", "[100, 50, 0.04]", three), "");  // slender: bending only
  EXPECT_EQ(layer_warning("[8, 4, 1]", "[1, 0.5, 0.04]", "[[stiff, 0, 0.02], [stiff, 0, 0.02]]"), "");
}

TEST(Plies, MayBeOneOnly) {
  const BuiltTestScene s(box("[2, 2, 1]") + kMaterials + region("[[stiff, 0, 0.2]]"));
  const auto find = find_extreme("body.tsai_wu.largest", s.model(), {});
  ASSERT_TRUE(find.has_value());
  const State state{0, s.zero(), s.zero()};
  EXPECT_NEAR((*find)(ObservedState(s.model(), state)).value, 0, 1e-12);
}

TEST(Plies, AreRefusedWithTheReason) {
  const auto message = [](const std::string& scene) -> std::string {
    try {
      const BuiltTestScene s(scene);
    } catch (const ConfigError& e) {
      return e.what();
    }
    return "";
  };
  const auto expect = [&](const std::string& scene, const std::string& part) {
    EXPECT_NE(message(scene).find(part), std::string::npos) << message(scene);
  };
  expect(box("[2, 2, 1]", "tetrahedra") + kMaterials + region(kThree), "a layup needs quadratic hexahedra or wedges");
  expect(box("[2, 2, 1]", "wedges") + kMaterials + region(kThree, "{first: [0, 1, 0], second: [0, 0, 1]}"),
         "no axis of cell 0 is within about 45 degrees of axis 3");
  expect("mesh: {type: box, size: [1, 1, 1], cells: [1, 1, 1], elements: hexahedra, order: 1}\n" + kMaterials +
             region(kThree),
         "has hexahedra of 8 nodes; a layup needs quadratic hexahedra or wedges");
  expect(box("[2, 2, 1]") + kMaterials + region("[[oak, 0, 0.2]]"), "'oak' is not among the materials: stiff, soft");
  expect(box("[2, 2, 1]") + kMaterials + "regions: {body: {material: soft, layup: [[soft, 0, 0.2]]}}\ntime: {end: 1}",
         "has no effect beside a layup");
  expect(
      box("[2, 2, 1]") + kMaterials + "regions: {body: {axes: {first: [1, 0, 0], second: [0, 1, 0]}}}\ntime: {end: 1}",
      "give a material or a layup");
  expect(box("[2, 2, 1]") + kMaterials + region("[[soft, 30, 0.2]]"), "an angle needs a unit");
  expect(box("[2, 2, 1]") + kMaterials + region("[[soft, 0]]"), "[material, angle, thickness]");
}

TEST(Plies, OfAnotherThicknessThanTheCellsAreScaledWithAWarning) {
  const BuiltTestScene s(box("[2, 2, 1]") + kMaterials + region("[[stiff, 0, 1 mm], [soft, 0, 3 mm]]"));
  ASSERT_FALSE(s.built.warnings.empty());
  EXPECT_NE(s.built.warnings[0].find("a total thickness of 0.004 m, but its cells along axis 3 are 0.2 m thick"),
            std::string::npos)
      << s.built.warnings[0];
  EXPECT_EQ(s.model().parts().elastic[0]->definition().share, 0.25);
}

}  // namespace
}  // namespace orthodyn::layup_test
