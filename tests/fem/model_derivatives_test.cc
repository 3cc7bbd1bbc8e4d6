// The whole model's force against its energy, and K and D against its force, by the observed order
// of central differences: an error in a derivative does not vanish with the step.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "lib/core/symmetric_eigen.h"
#include "lib/mesh/box.h"
#include "lib/mesh/quadratic.h"
#include "tests/fem/built_scene.h"
#include "tests/fem/derivatives.h"

namespace orthodyn::model_derivatives_test {
namespace {

struct Case {
  std::string name, material, extra, axes = kTurnedAxes;
  bool curved = false;      // quadratic elements with curved edges
  std::string region = "";  // further keys of the region
};
void PrintTo(const Case& c, std::ostream* os) { *os << c.name; }

const Case kExact{"exact", fibre_material(10), ""};
const Case kIsotropicCase{"isotropic", "{type: isotropic, density: 1, young: 2, nu: 0.3}", ""};
const Case kWarped{"warped_unsymmetric", fibre_material(10),
                   "elasticity: {corotation: warped, warped_tangent: unsymmetric}"};
const Case kLinear{"linear", fibre_material(10), "elasticity: {kinematics: linear}"};
const Case kAnisotropic{"anisotropic", turned_fibre_material(10, Random(109).rotation()), ""};
const Case kTwoRegions{"two_regions", fibre_material(10), ""};
const std::string kCylinder = "{type: cylindrical, point: [0.3, 0.4, 0], axis: [0.2, 0.1, 1], spiral: 0.2 rad}";
const Case kGrain{"grain", fibre_material(10), "", kCylinder};
const Case kLinearGrain{"linear_grain", fibre_material(10), "elasticity: {kinematics: linear}", kCylinder};
const Case kWarpedGrain{"warped_grain", fibre_material(10),
                        "elasticity: {corotation: warped, warped_tangent: unsymmetric}", kCylinder};

const Case kCurved{"curved", fibre_material(10), "", kCylinder, true};
const Case kCurvedLinear{"curved_linear", fibre_material(10), "elasticity: {kinematics: linear}", kTurnedAxes, true};
const Case kCurvedWarped{"curved_warped", fibre_material(10),
                         "elasticity: {corotation: warped, warped_tangent: unsymmetric}", kTurnedAxes, true};
const Case kCurvedIsotropic{"curved_isotropic", "{type: isotropic, density: 1, young: 2, nu: 0.3}", "mass: consistent",
                            kTurnedAxes, true};

// Swelling by a formula, with coefficients of different sign.
std::string swelling(std::string material) {
  material.insert(material.size() - 1, ", expansion: {moisture: [-0.02, 0.1, 0.3]}");
  return material;
}
const std::string kMoist = "moisture: {change: 0.5 + 0.4*x - 0.3*y*z}\n";
const Case kSwelling{"swelling", swelling(fibre_material(10)), kMoist};
const Case kLinearSwelling{"linear_swelling", swelling(fibre_material(10)),
                           kMoist + "elasticity: {kinematics: linear}"};
const Case kCurvedSwelling{"curved_swelling", swelling(turned_fibre_material(10, Random(109).rotation())), kMoist,
                           kCylinder, true};

const std::string kSoft = "{type: isotropic, density: 1, young: 2, nu: 0.3}", kLaw = "law: neo_hookean, ";
const Case kRubber{"rubber", kSoft, "", kTurnedAxes, false, kLaw};
const Case kCurvedRubber{"curved_rubber", kSoft, "", kTurnedAxes, true, kLaw};

// A clamped block of two by two by one cells, one corner of it free in x only. With `two_regions` the
// half x > 0.5 is a softer material with more damping.
BuiltTestScene block(const Case& c, const std::string& more = "") {
  Mesh mesh = make_box({.cells = {2, 2, 1}});
  const bool two = c.name == "two_regions";
  if (two) {
    mesh.region_names.push_back("soft");
    for (std::size_t e = 0; e < mesh.cells.size(); ++e)
      mesh.region_of[e] = centroid(mesh, static_cast<int>(e))[0] > 0.5;
  }
  if (c.curved) {
    Random random(110);
    make_quadratic(mesh, [&](int a, int b) {
      const Vec3 middle = (mesh.nodes[static_cast<std::size_t>(a)] + mesh.nodes[static_cast<std::size_t>(b)]) / 2;
      return Vec3(middle + 0.02 * random.vector());
    });
  }
  given_mesh() = mesh;
  const std::string soft =
      two ? "soft: {material: soft, axes: {first: [0, 1, 0], second: [0, 0, 1]}, stiffness_damping: 0.3}" : "";
  return BuiltTestScene(fmt::format(R"(
mesh: {{type: given}}
materials: {{stiff: {}, soft: {{type: isotropic, density: 2, young: 0.5, nu: 0.2}}}}
regions: {{body: {{material: stiff, {}axes: {}}}, {}}}
clamps: [{{surface: x0}}, {{nearest: [1, 1, 1], components: [y, z]}}]
time: {{end: 1}}
{}
{}
)",
                                    c.material, c.region, c.axes, soft, c.extra, more));
}

class Derivatives : public testing::TestWithParam<Case> {};
class ConservativeDerivatives : public Derivatives {};
const auto name_of = [](const auto& tested) { return tested.param.name; };
INSTANTIATE_TEST_SUITE_P(Models, Derivatives,
                         testing::Values(kExact, kIsotropicCase, kAnisotropic, kWarped, kLinear, kTwoRegions, kGrain,
                                         kLinearGrain, kWarpedGrain, kCurved, kCurvedLinear, kCurvedWarped,
                                         kCurvedIsotropic, kSwelling, kLinearSwelling, kCurvedSwelling, kRubber,
                                         kCurvedRubber),
                         name_of);
INSTANTIATE_TEST_SUITE_P(Models, ConservativeDerivatives,
                         testing::Values(kExact, kIsotropicCase, kAnisotropic, kLinear, kTwoRegions, kGrain,
                                         kLinearGrain, kCurved, kCurvedLinear, kCurvedIsotropic, kSwelling,
                                         kLinearSwelling, kCurvedSwelling, kRubber, kCurvedRubber),
                         name_of);

TEST_P(ConservativeDerivatives, ForceIsMinusTheGradientOfElasticAndGravitationalEnergy) {
  Random random(101);
  const auto scene = block(GetParam(), "gravity: [0.3, -2, 1]");
  for (int sample = 0; sample < 3; ++sample) {
    const Vector q = random_dofs(random, scene.size(), 0.05), d = random_dofs(random, scene.size(), 1);
    expect_derivative([&](double h) { return one(scene.potential(q + h * d)); }, one(-scene.force(q).dot(d)));
  }
}

TEST_P(Derivatives, StiffnessIsMinusTheDerivativeOfTheForceByPosition) {
  Random random(102);
  const auto scene = block(GetParam(), "damping: {stiffness: 0.1, mass: 0.5}");
  const Vector q = random_dofs(random, scene.size(), 0.05);
  const Eigen::MatrixXd K = scene.stiffness(q);
  for (int sample = 0; sample < 3; ++sample) {
    const Vector d = random_dofs(random, scene.size(), 1);
    expect_derivative([&](double h) { return scene.force(q + h * d); }, -K * d);
  }
}

TEST_P(Derivatives, DampingIsMinusTheDerivativeOfTheForceByVelocityWhichIsLinear) {
  Random random(103);
  const auto scene = block(GetParam(), "damping: {stiffness: 0.1, mass: 0.5}");
  const Vector q = random_dofs(random, scene.size(), 0.05), v = random_dofs(random, scene.size(), 1);
  const Eigen::MatrixXd D = scene.matrix({0, 1, 0}, q, v);
  for (int sample = 0; sample < 3; ++sample) {
    const Vector d = random_dofs(random, scene.size(), 1);
    const Vector change = scene.force(q, v + d) - scene.force(q, v);
    EXPECT_LE((change + D * d).norm(), 1e-13 * (scene.force(q, v).norm() + change.norm()));
  }
}

TEST_P(ConservativeDerivatives, StiffnessAndDampingAreSymmetric) {
  Random random(104);
  const auto scene = block(GetParam(), "damping: {stiffness: 0.1}");
  const Vector q = random_dofs(random, scene.size(), 0.05);
  // The columns of K, by differences: the matrix itself is stored as symmetric.
  Eigen::MatrixXd K(scene.size(), scene.size());
  for (int j = 0; j < scene.size(); ++j) {
    const Vector e = 1e-5 * Vector::Unit(scene.size(), j);
    K.col(j) = (scene.force(q - e) - scene.force(q + e)) / 2e-5;
  }
  EXPECT_LE((K - K.transpose()).norm(), 1e-8 * K.norm());
  EXPECT_LE((K - scene.stiffness(q)).norm(), 1e-8 * K.norm());
}

TEST(WarpedForce, HasAnUnsymmetricTangent) {
  Random random(105);
  const auto scene = block(kWarped);
  const Eigen::MatrixXd K = scene.stiffness(random_dofs(random, scene.size(), 0.05));
  EXPECT_GE((K - K.transpose()).norm(), 1e-3 * K.norm());
}

TEST_P(Derivatives, GaussNewtonTangentIsPositiveSemidefinite) {
  Random random(106);
  const auto scene = block(GetParam());
  for (const double amplitude : {0.05, 0.3, 1.0}) {
    if (!GetParam().region.empty() && amplitude > 0.05) break;  // rubber cannot be inverted
    const Vector q = random_dofs(random, scene.size(), amplitude);
    const Eigen::MatrixXd K = scene.matrix({0, 0, 1}, q, scene.zero(), TangentKind::gauss_newton);
    const Vector lambda = symmetric_eigenvalues(Eigen::MatrixXd(0.5 * (K + K.transpose())));
    EXPECT_GE(lambda[0], -1e-13 * lambda[scene.size() - 1]) << amplitude;
  }
}

TEST(ExactTangent, IsIndefiniteUnderStrongCompressionAndGaussNewtonIsNot) {
  const auto scene = block(kExact);
  const Vector q = scene.dofs([](const Vec3& X) { return Vec3(-0.4 * X[0], 0, 0); });
  EXPECT_LT(symmetric_eigenvalues(scene.stiffness(q))[0], -1e-3);
}

TEST_P(Derivatives, CombineIsTheWeightedSum) {
  Random random(107);
  const auto scene = block(GetParam(), "damping: {stiffness: 0.1, mass: 0.5}");
  const Vector q = random_dofs(random, scene.size(), 0.05), v = scene.zero();
  const Eigen::MatrixXd sum =
      2 * scene.matrix({1, 0, 0}, q, v) + 3 * scene.matrix({0, 1, 0}, q, v) + 5 * scene.matrix({0, 0, 1}, q, v);
  EXPECT_LE((scene.matrix({2, 3, 5}, q, v) - sum).norm(), 16 * kEps * sum.norm());
}

}  // namespace
}  // namespace orthodyn::model_derivatives_test
