// Models with fibres: derivatives of the whole force, mean force, traits, and bodies of several materials.
#include <gtest/gtest.h>

#include "lib/core/symmetric_eigen.h"
#include "tests/config/messages.h"
#include "tests/fem/built_scene.h"
#include "tests/fem/derivatives.h"

namespace orthodyn::fibre_model_test {
namespace {

const std::string kPassive = "passive: {type: exponential, k1: 5, k2: 0.5}";
const std::string kActive = "active: {stress: 4, length: {type: gaussian, optimal_stretch: 1.1}}";
const std::string kHill = "active: {stress: 4, velocity: {type: hill, shortening_velocity: 6}}";
const std::string kActivation = "activation: {value: 0.2 + 0.3*x}\n";

struct Variant {
  std::string name, fibres, more;
  int order = 1;
};
void PrintTo(const Variant& v, std::ostream* os) { *os << v.name; }

std::string block(const Variant& v, const std::string& more = "") {
  return "mesh: {type: box, size: [1, 0.8, 0.6], cells: [2, 1, 1], order: " + std::to_string(v.order) +
         "}\nmaterials: {m: {type: isotropic, density: 1, young: 10, nu: 0.3, fibres: {" + v.fibres +
         "}}}\nregions: {all: {material: m, axes: " + kTurnedAxes + "}}\nclamps: [{surface: x0}]\ntime: {end: 1}\n" +
         v.more + more;
}

class FibreModels : public testing::TestWithParam<Variant> {};
INSTANTIATE_TEST_SUITE_P(Models, FibreModels,
                         testing::Values(Variant{"passive", kPassive, ""}, Variant{"active", kActive, kActivation},
                                         Variant{"both", kPassive + ", " + kHill, kActivation},
                                         Variant{"linear", kPassive + ", " + kActive,
                                                 kActivation + "elasticity: {kinematics: linear}\n"},
                                         Variant{"quadratic", kPassive + ", " + kActive, kActivation, 2}),
                         [](const auto& tested) { return tested.param.name; });

// All fibres stretched, away from the kink at their rest length.
Vector stretched(const BuiltTestScene& s, Random& random) {
  return s.dofs([](const Vec3& X) { return Vec3(0.3 * X); }) + random_dofs(random, s.size(), 0.01);
}

TEST_P(FibreModels, TheForceIsMinusTheGradientOfTheEnergy) {
  Random random(201);
  const BuiltTestScene s(block(GetParam()));
  const Vector q = stretched(s, random), d = random_dofs(random, s.size(), 0.2);
  expect_derivative([&](double h) { return one(s.potential(q + h * d)); }, one(-s.force(q).dot(d)));
}

TEST_P(FibreModels, TheStiffnessIsMinusTheDerivativeOfTheForce) {
  Random random(202);
  const BuiltTestScene s(block(GetParam(), "damping: {stiffness: 0.05}\n"));
  const Vector q = stretched(s, random), d = random_dofs(random, s.size(), 0.2);
  expect_derivative([&](double h) { return s.force(q + h * d); }, -s.stiffness(q) * d);
}

TEST_P(FibreModels, TheDampingIsMinusTheDerivativeByVelocity) {
  Random random(203);
  const BuiltTestScene s(block(GetParam(), "damping: {stiffness: 0.05}\n"));
  const Vector q = stretched(s, random), v = random_dofs(random, s.size(), 1), d = random_dofs(random, s.size(), 5);
  expect_derivative([&](double h) { return s.force(q, v + h * d); }, -s.matrix({0, 1, 0}, q, v) * d);
}

TEST_P(FibreModels, TheGaussNewtonStiffnessIsPositiveSemidefinite) {
  Random random(204);
  const BuiltTestScene s(block(GetParam()));
  for (const double amplitude : {0.05, 0.3}) {
    const Vector q = random_dofs(random, s.size(), amplitude), v = random_dofs(random, s.size(), 1);
    const Vector values = symmetric_eigenvalues(s.matrix({0, 0, 1}, q, v, TangentKind::gauss_newton));
    EXPECT_GE(values[0], -1e-13 * values[s.size() - 1]) << amplitude;
  }
}

TEST_P(FibreModels, TheMeanForceDoesTheWorkOfTheEnergy) {
  Random random(205);
  const BuiltTestScene s(block(GetParam()));
  const Vector q0 = stretched(s, random), q1 = 0.2 * stretched(s, random);
  Vector f(s.size());
  s.model().discrete_gradient()->mean_force(0, q0, 0.1, q1, s.zero(), f);
  EXPECT_NEAR(f.dot(q1 - q0), s.potential(q0) - s.potential(q1), 1e-13 * (s.potential(q0) + s.potential(q1)));
}

// The balance of a state: the rate of the energy is the power of the inner forces.
TEST_P(FibreModels, TheDissipatedPowerIsThatOfTheForce) {
  Random random(206);
  const BuiltTestScene s(block(GetParam()));
  const Vector q = stretched(s, random), v = random_dofs(random, s.size(), 1);
  const double power = (s.force(q, v) - s.force(q)).dot(v), dissipated = s.scalar("power.dissipated", q, v);
  EXPECT_NEAR(dissipated, -power, 1e-12 * (1 + std::abs(power)));
  EXPECT_EQ(dissipated > 1e-3, GetParam().name == "both");
}

TEST(FibreModel, TheTraitsAreThoseOfTheFibres) {
  const Variant linear{"", kPassive, "elasticity: {kinematics: linear}\n"};
  EXPECT_FALSE(BuiltTestScene(block(linear)).model().traits().linear);
  EXPECT_TRUE(BuiltTestScene(block(linear)).model().traits().conservative);
  const Traits still = BuiltTestScene(block({"", kActive, kActivation})).model().traits();
  EXPECT_TRUE(still.conservative && !still.time_dependent && !still.loaded && !still.damping_matrix);
  const Traits changing = BuiltTestScene(block({"", kHill, "activation: {formula: t*x}\n"})).model().traits();
  EXPECT_TRUE(!changing.conservative && changing.time_dependent && changing.loaded && changing.damping_matrix &&
              changing.dissipative);
}

// The force of one region's fibres acts on its nodes only.
TEST(FibreModel, OnlyMaterialsWithFibresContract) {
  const BuiltTestScene s(block({"", kActive, kActivation}));
  const BuiltTestScene matrix(block({"", kActive, "activation: {value: 0}\n"}));
  EXPECT_GT(s.force(s.zero()).norm(), 0.1);
  EXPECT_EQ(matrix.force(matrix.zero()).norm(), 0);
  const NodalVector f = s.nodal(s.force(s.zero()));
  EXPECT_GT(f.norm(), 0);
}

std::string refused(const Variant& v) {
  return refusal([&] { BuiltTestScene scene(block(v)); });
}

TEST(FibreModel, RefusesActivationsThatDoNotFit) {
  EXPECT_TRUE(holds(refused({"", kActive, ""}), "needs the scene's section 'activation'"));
  EXPECT_TRUE(holds(refused({"", kPassive, kActivation}), "has no effect: no material has"));
  EXPECT_TRUE(holds(refused({"", kActive, "activation: {value: 0.2 + x}\n"}), "it must stay between 0 and 1"));
  EXPECT_TRUE(holds(refused({"", kActive, "activation: {value: 0.9, factor: {type: ramp, end: 0.5, value: 2}}\n"}),
                    "is 1.8 at t = 0.5 s in the element at ("));
  EXPECT_TRUE(holds(refused({"", kActive, "activation: {factor: {type: ramp, end: 0.5}}\n"}),
                    "give one of value, formula and file"));
}

// Formulas may leave the range between the times that are checked before the run.
TEST(FibreModel, RefusesActivationsDuringTheRun) {
  const BuiltTestScene s(block({"", kActive, "activation: {formula: 4.4*t*(1 - t)}\n"}));
  EXPECT_NO_THROW(s.force(s.zero(), s.zero(), 0.3));
  EXPECT_TRUE(holds(refusal([&] { s.force(s.zero(), s.zero(), 0.5); }), "is 1.1 at t = 0.5 s"));
}

}  // namespace
}  // namespace orthodyn::fibre_model_test
