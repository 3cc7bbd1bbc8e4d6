// Nearly incompressible bodies: the choice of the mixed formulation, a cylinder and a cube under pressure.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <numbers>

#include "lib/core/errors.h"
#include "lib/mesh/box.h"
#include "lib/mesh/quadratic.h"
#include "lib/mesh/selection.h"
#include "lib/simulation/statics/static_problem.h"
#include "tests/problems/running.h"

namespace orthodyn::nearly_incompressible_test {
namespace {

std::string isotropic(double nu) { return fmt::format("{{type: isotropic, density: 1, young: 1e6, nu: {}}}", nu); }

bool is_mixed(const std::string& material, const std::string& mesh = "order: 2", const std::string& region = "",
              const std::string& more = "") {
  const BuiltTestScene s("mesh: {type: box, size: [1, 1, 1], cells: [1, 1, 1], " + mesh + "}\nmaterials: {m: " +
                         material + "}\nregions: {all: {material: m" + region + "}}\ntime: {end: 1}\n" + more);
  return s.model().parts().elastic.front()->definition().mixed;
}

TEST(NearlyIncompressible, IsMixedWhereTheMaterialAsksForIt) {
  EXPECT_FALSE(is_mixed(isotropic(0.3)));
  EXPECT_FALSE(is_mixed(isotropic(0.45)));
  EXPECT_TRUE(is_mixed(isotropic(0.48)));
  EXPECT_TRUE(is_mixed(isotropic(0.4999)));
  for (const char* elements : {"elements: hexahedra", "elements: wedges"})
    for (const char* order : {"1", "2"})
      EXPECT_TRUE(is_mixed(isotropic(0.49), fmt::format("{}, order: {}", elements, order))) << elements << order;
  EXPECT_FALSE(is_mixed("{type: preset, name: sitka_spruce}"));  // its stiffest strain is along the grain
}

TEST(NearlyIncompressible, IsMixedOrNotAsTheRegionSays) {
  EXPECT_TRUE(is_mixed(isotropic(0.3), "order: 2", ", formulation: mixed"));
  EXPECT_FALSE(is_mixed(isotropic(0.49), "order: 2", ", formulation: displacement"));
}

TEST(NearlyIncompressible, IsNotMixedWhereThereIsNoSuchFormulation) {
  const std::string warped = "elasticity: {corotation: warped}\n";
  EXPECT_FALSE(is_mixed(isotropic(0.49), "order: 1"));
  EXPECT_FALSE(is_mixed(isotropic(0.49), "order: 2", "", warped));
  EXPECT_THROW(is_mixed(isotropic(0.49), "order: 1", ", formulation: mixed"), ConfigError);
  EXPECT_THROW(is_mixed(isotropic(0.49), "order: 2", ", formulation: mixed", warped), ConfigError);
}

struct Kind {
  const char* name;
  BoxMesh::Elements elements;
  bool centres;
};
void PrintTo(const Kind& kind, std::ostream* os) { *os << kind.name; }

constexpr Kind kKinds[] = {{"tet10", BoxMesh::Elements::tetrahedra, false},
                           {"hex20", BoxMesh::Elements::hexahedra, false},
                           {"hex27", BoxMesh::Elements::hexahedra, true},
                           {"wedge15", BoxMesh::Elements::wedges, false},
                           {"wedge18", BoxMesh::Elements::wedges, true}};

// A quarter of a cylinder of radii 1 and 2 m with `cells` through the wall, in plane strain, pressed from inside by 1
// Pa.
BuiltTestScene cylinder(const Kind& kind, int cells, double nu, const char* formulation) {
  Mesh mesh = make_box({.size = Vec3(1, 1, 1.0 / cells), .cells = {cells, 2 * cells, 1}, .elements = kind.elements});
  make_quadratic(mesh);
  if (kind.centres) add_centres(mesh);
  for (Vec3& x : mesh.nodes) {
    const double r = 1 + x[0], angle = std::numbers::pi / 2 * x[1];
    x = Vec3(r * std::cos(angle), r * std::sin(angle), x[2]);
  }
  given_mesh() = mesh;
  return BuiltTestScene(
      fmt::format("mesh: {{type: given}}\nmaterials: {{m: {}}}\nregions: {{all: {{material: m, "
                  "formulation: {}}}}}\nanalysis: static\nelasticity: {{kinematics: linear}}\n"
                  "clamps: [{{surface: y0, components: [y]}}, {{surface: y1, components: [x]}}, "
                  "{{surface: z0, components: [z]}}, {{surface: z1, components: [z]}}]\n"
                  "terms: [{{type: pressure, surface: x0, pressure: 1}}]\n",
                  isotropic(nu), formulation));
}

// Root mean square over the nodes of the error of the stresses in the plane, over the largest stress.
double stress_error(const BuiltTestScene& s) {
  const Vector q = linear_static(s);
  const auto stress = s.model().evaluate("nodal_stress", {0, q, s.zero()});
  const NodalVector& X = *s.model().parts().rest;
  double sum = 0;
  for (Eigen::Index n = 0; n < X.cols(); ++n) {
    const double* at = &stress[6 * static_cast<std::size_t>(n)];  // xx, yy, zz, xy, yz, zx
    const double r = X.col(n).head<2>().norm(), mean = 1.0 / 3, difference = 4.0 / 3 / (r * r);
    const Eigen::Vector2d e = X.col(n).head<2>() / r;
    Eigen::Matrix2d sigma,
        exact = (mean + difference) * Eigen::Matrix2d::Identity() - 2 * difference * e * e.transpose();
    sigma << at[0], at[3], at[3], at[1];
    sum += (sigma - exact).squaredNorm();
  }
  constexpr double kLargest = 5.0 / 3;
  return std::sqrt(sum / static_cast<double>(X.cols())) / kLargest;
}

class Cylinder : public testing::TestWithParam<Kind> {};
INSTANTIATE_TEST_SUITE_P(Kind, Cylinder, testing::ValuesIn(kKinds), [](const auto& one) { return one.param.name; });

class MixedBeam : public testing::TestWithParam<Kind> {};
INSTANTIATE_TEST_SUITE_P(Kind, MixedBeam, testing::ValuesIn(kKinds), [](const auto& one) { return one.param.name; });

// A cantilever with one cell through its thickness, of length 1, height 0.1 and E = 1e6, whose deflection under a force
// of 1 N is F L^3 / (3 E I) + F L / (G A 5/6) = 0.0404 m.
TEST_P(MixedBeam, BendsAsABeamWithOneCellThroughTheThickness) {
  const Kind& kind = GetParam();
  Mesh mesh = make_box({.size = Vec3(1, 0.1, 0.1), .cells = {10, 1, 1}, .elements = kind.elements});
  make_quadratic(mesh);
  if (kind.centres) add_centres(mesh);
  given_mesh() = mesh;
  const BuiltTestScene s(
      "mesh: {type: given}\nmaterials: {m: " + isotropic(0.4999) +
      "}\nregions: {all: {material: m}}\nanalysis: static\nelasticity: {kinematics: linear}\nclamps: "
      "[{surface: x0}]\nloads: [{surface: x1, force: [0, 0, 1]}]\n");
  ASSERT_TRUE(s.model().parts().elastic.front()->definition().mixed);
  EXPECT_NEAR(s.nodal(linear_static(s))(2, nearest_node(s.mesh(), {1, 0, 0})), 0.0404, 0.08 * 0.0404);
}

// Constant pressures of tetrahedra are of first order.
TEST_P(Cylinder, HasLamesStressesAtEachPoissonsRatio) {
  const double limit = std::string_view(GetParam().name) == "tet10" ? 0.025 : 0.01;
  for (const double nu : {0.3, 0.49, 0.499, 0.4999})
    EXPECT_LT(stress_error(cylinder(GetParam(), 8, nu, "mixed")), limit) << nu;
}

TEST_P(Cylinder, LosesNothingWhereTheMaterialIsCompressible) {
  const double mixed = stress_error(cylinder(GetParam(), 4, 0.3, "mixed"));
  EXPECT_LT(mixed, 1.15 * stress_error(cylinder(GetParam(), 4, 0.3, "displacement")));
}

// The reason for the mixed formulation.
TEST(NearlyIncompressible, HasWrongStressesWithDisplacementsAlone) {
  EXPECT_GT(stress_error(cylinder(kKinds[0], 8, 0.4999, "displacement")), 0.04);  // tetrahedra
  EXPECT_GT(stress_error(cylinder(kKinds[2], 8, 0.4999, "displacement")), 1);     // hexahedra of 27 nodes
}

// Pressure changes the shape of a nearly incompressible orthotropic body: its strain is -p S : I with the compliance S.
TEST(NearlyIncompressible, HasTheStrainOfAnisotropicBodiesUnderPressure) {
  const BuiltTestScene s(
      "mesh: {type: box, size: [1, 1, 1], cells: [2, 2, 2]}\nmaterials: {m: {type: orthotropic, density: 1, young: "
      "[4e6, "
      "1e6, 1e6], nu12: 0.52, nu23: 0.855, nu31: 0.1249, g12: 4e5, g23: 3e5, g13: 5e5}}\nregions: {all: {material: m, "
      "formulation: mixed}}\nanalysis: static\nelasticity: {kinematics: linear}\nclamps: [{surface: x0, components: "
      "[x]}, {surface: y0, components: [y]}, {surface: z0, components: [z]}]\nterms: [{type: pressure, pressure: "
      "1000}]\n");
  const Mat6 S = s.model().parts().elastic.front()->stiffness().inverse();
  const Vec3 strain = -1000 * S.topLeftCorner<3, 3>().rowwise().sum();
  EXPECT_GT(strain.maxCoeff(), 0);  // in one direction it grows
  const Vector expected = s.dofs([&](const Vec3& x) { return Vec3(strain.cwiseProduct(x)); });
  EXPECT_LT((linear_static(s) - expected).norm(), 1e-9 * expected.norm());
}

// In all elements a uniform stretch has the energy density mu |S - I|^2 + lambda/2 (J - 1)^2.
class Stretched : public testing::TestWithParam<Kind> {};
INSTANTIATE_TEST_SUITE_P(Kind, Stretched, testing::ValuesIn(kKinds), [](const auto& one) { return one.param.name; });

TEST_P(Stretched, HasTheEnergyOfItsShapeAndOfItsVolume) {
  Mesh mesh = make_box({.size = Vec3::Ones(), .cells = {2, 1, 1}, .elements = GetParam().elements});
  make_quadratic(mesh);
  if (GetParam().centres) add_centres(mesh);
  given_mesh() = mesh;
  const double young = 1e6, nu = 0.4999, mu = young / (2 * (1 + nu)), lambda = 2 * mu * nu / (1 - 2 * nu);
  const BuiltTestScene s("mesh: {type: given}\nmaterials: {m: " + isotropic(nu) +
                         "}\nregions: {all: {material: m}}\ntime: {end: 1}\n");
  Random random(801);
  const Mat3 R = random.rotation();
  for (const Vec3& stretches : {Vec3(1.5, 0.8, 1 / 1.2), Vec3(0.6, 1 / 0.6, 1), Vec3(1.001, 1, 1)}) {
    const double J_1 = stretches.prod() - 1;
    const double expected = mu * (stretches - Vec3::Ones()).squaredNorm() + lambda / 2 * J_1 * J_1;
    const Mat3 F = R * stretches.asDiagonal();
    EXPECT_NEAR(s.potential(s.dofs([&](const Vec3& x) { return Vec3(F * x - x); })), expected, 1e-9 * expected);
  }
}

// A block between bonded plates, compressed by a tenth. Its volume is to stay.
TEST(NearlyIncompressible, KeepsItsVolumeInLargeDeformation) {
  const BuiltTestScene s(
      "mesh: {type: box, size: [1, 1, 0.4], cells: [4, 4, 3], elements: hexahedra}\nmaterials: {m: " +
      isotropic(0.4999) +
      "}\nregions: {all: {material: m}}\nanalysis: static\nclamps: [{surface: z0}]\n"
      "motions: [{surface: z1, displacement: [0, 0, -0.04]}]\n");
  const State end{s.scene.time.end, equilibrium(s.scene, s.built), s.zero()};
  EXPECT_GT(s.model().evaluate("det_f.smallest", end)[0], 0.9);
}

}  // namespace
}  // namespace orthodyn::nearly_incompressible_test
