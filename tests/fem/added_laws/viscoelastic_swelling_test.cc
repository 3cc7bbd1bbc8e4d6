// Materials that swell and relax: the internal variables follow the strain without the stress-free strain.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "lib/ode/internal_history.h"
#include "tests/fem/built_scene.h"
#include "tests/fem/derivatives.h"

namespace orthodyn::viscoelastic_swelling_test {
namespace {

using Kind = InternalState::Kind;

const Vec3 kCoefficients(-0.02, 0.1, 0.3);
constexpr double kTime = 0.6;  // s
constexpr const char* kBranches =
    ", viscoelastic: [{time: 0.1, share: 0.3}, {time: 3, normal: [0.1, 0.4, 0], shear: [0.2, 0.6, 0.1]}]";
constexpr const char* kMoving = "moisture: {formula: '0.3*exp(-t)*(1 + x) + 0.2*sin(3*t)*z'}";

std::string block(const std::string& branches, const std::string& more, const std::string& young = "[10, 1, 2]") {
  return fmt::format(R"(
mesh: {{type: box, size: [1, 0.8, 0.6], cells: [2, 1, 1]}}
materials:
  m: {{type: orthotropic_stable, density: 1, young: {}, nu: 0.3, expansion: {{moisture: [-0.02, 0.1, 0.3]}}{}}}
regions: {{all: {{material: m, axes: {}}}}}
time: {{end: 2}}
{}
)",
                     young, branches, kTurnedAxes, more);
}

std::string with(const std::string& kinematics) { return "\nelasticity: {kinematics: " + kinematics + "}"; }

struct Body {
  explicit Body(const std::string& more, const std::string& branches = kBranches)
      : s(block(branches, more)), internal(*s.model().internal_variables()) {}

  Vector random_internals(Random& random) const { return random_dofs(random, internal.size(), 0.1); }
  Vector strains(double t, const Vector& q) const {
    Vector e(internal.size());
    internal.strains(t, q, e);
    return e;
  }
  Vector total_strains(const Vector& q) const {
    Vector e(internal.size());
    internal.total_strains(0, q, e);
    return e;
  }
  Vector force(const Vector& q, const InternalState& z) const {
    Vector f(s.size());
    internal.force(kTime, q, s.zero(), z, f);
    return f;
  }
  Vector force(const Vector& q, const Vector& z) const { return force(q, {Kind::given, z.data(), 0}); }
  Vector stiffness(const Vector& q, const InternalState& z, const Vector& dq) const {
    Linearization at;
    internal.assemble(kTime, q, s.zero(), z, TangentKind::exact, at);
    std::vector<double> values(s.model().pattern().row.size());
    s.model().combine({0, 0, 1}, at, values.data());
    Vector y(s.size());
    s.model().multiply_matrix(values.data(), dq, y);
    return y;
  }
  double output(const char* name, double t, const Vector& q, const Vector& z) const {
    return s.model().evaluate(name, {t, q, s.zero(), 1, z})[0];
  }

  BuiltTestScene s;
  const InternalVariables& internal;
};

class Kinematics : public testing::TestWithParam<const char*> {};
INSTANTIATE_TEST_SUITE_P(RelaxingSwelling, Kinematics, testing::Values("corotational", "linear"));

// Free swelling causes no stress at once and none later: nothing relaxes.
TEST(RelaxingSwelling, OfAFreeBodyHasNoForceAndNothingRelaxes) {
  const Body body("moisture: {change: 0.8}");
  const Mat3 axes = body.s.model().parts().elastic.front()->axes_at_rest(0, 0),
             F = Mat3::Identity() + axes * (0.8 * kCoefficients).asDiagonal() * axes.transpose();
  const Mat3 R = Eigen::AngleAxisd(2, Vec3(1, 2, -1).normalized()).toRotationMatrix();
  const Vector q = body.s.dofs([&](const Vec3& X) { return Vec3(R * F * X - X); });
  const Vector none = Vector::Zero(body.internal.size());
  const double scale = body.force(body.s.zero(), none).norm();
  EXPECT_GE(scale, 0.01);
  EXPECT_LE(body.force(q, none).norm(), 1e-13 * scale);
  EXPECT_LE(body.strains(kTime, q).norm(), 1e-14 * std::sqrt(body.internal.size()));
  EXPECT_NEAR(body.output("energy.elastic", kTime, q, none), 0, 1e-14);
  EXPECT_NEAR(body.output("power.dissipated", kTime, q, none), 0, 1e-14);
}

// Forces and energy of a body that is held are those of an elastic body: with the stiffness at once before relaxation,
// and with the relaxed stiffness after it.
TEST_P(Kinematics, OfAHeldBodyRelaxesToTheRelaxedStiffness) {
  const std::string more = "moisture: {change: 0.8}" + with(GetParam());
  const Body body(more, ", viscoelastic: [{time: 0.1, share: 0.3}, {time: 3, share: 0.2}]");
  const BuiltTestScene at_once(block("", more)), relaxed(block("", more, "[5, 0.5, 1]"));
  Random random(431);
  const Vector q = random_dofs(random, body.s.size(), 0.02), none = Vector::Zero(body.internal.size()),
               all = body.strains(kTime, q);
  const auto energy = [&](const BuiltTestScene& s) {
    return s.model().evaluate("energy.elastic", {kTime, q, s.zero()})[0];
  };
  const Vector zero = body.s.zero(), f = at_once.force(zero);
  EXPECT_LE((body.force(zero, none) - f).norm(), 1e-13 * f.norm());
  EXPECT_NEAR(body.output("energy.elastic", kTime, zero, none),
              at_once.model().evaluate("energy.elastic", {kTime, zero, zero})[0], 1e-14);
  const Vector f_relaxed = relaxed.force(q);
  EXPECT_LE((body.force(q, all) - f_relaxed).norm(), 1e-12 * f_relaxed.norm());
  EXPECT_LE((body.s.force(q) - f_relaxed).norm(), 1e-12 * f_relaxed.norm());
  EXPECT_NEAR(body.output("energy.elastic", kTime, q, all), energy(relaxed), 1e-13);
  const auto half = [&](const BuiltTestScene& s) { return s.model().evaluate("nodal_stress", {kTime, q, zero, 0.5}); };
  const auto stress = half(body.s), expected = half(relaxed);
  double largest = 0;
  for (const double x : expected) largest = std::max(largest, std::abs(x));
  for (std::size_t i = 0; i < stress.size(); ++i) EXPECT_NEAR(stress[i], expected[i], 1e-12 * largest);
}

TEST_P(Kinematics, HasExactDerivatives) {
  const Body body(kMoving + with(GetParam()));
  Random random(432);
  const Vector q = random_dofs(random, body.s.size(), 0.03), dq = random_dofs(random, body.s.size(), 1),
               z = body.random_internals(random), dz = body.random_internals(random);
  expect_derivative([&](double h) { return one(body.output("energy.elastic", kTime, q + h * dq, z)); },
                    one(-body.force(q, z).dot(dq)));
  for (const InternalState& state :
       {InternalState{Kind::given, z.data(), 0}, InternalState{Kind::relaxed, nullptr, 0},
        InternalState{Kind::history, z.data(), 0.7}, InternalState{Kind::branch, nullptr, 3}})
    expect_derivative([&](double h) { return body.force(q + h * dq, state); }, -body.stiffness(q, state, dq));
  Vector de(z.size()), df(q.size());
  body.internal.strain_change(kTime, q, dq, de);
  expect_derivative([&](double h) { return body.strains(kTime, q + h * dq); }, de);
  body.internal.force_change(kTime, q, dz, df);
  EXPECT_LE((body.force(q, z + dz) - body.force(q, z) - df).norm(), 1e-13 * df.norm());
}

// At a fixed shape the energy changes by the power of swelling and by dissipation.
TEST_P(Kinematics, EnergyAtAFixedShapeIsThatOfPowerAndDissipation) {
  const Body body(kMoving + with(GetParam()));
  Random random(433);
  const Vector q = random_dofs(random, body.s.size(), 0.03), z = body.random_internals(random);
  const Vector rate = (body.strains(kTime, q) - z).cwiseQuotient(body.internal.relaxation_times());
  const double dissipated = body.output("power.dissipated", kTime, q, z);
  EXPECT_GT(dissipated, 0);
  expect_derivative([&](double h) { return one(body.output("energy.elastic", kTime + h, q, z + h * rate)); },
                    one(body.output("power.loads", kTime, q, z) - dissipated));
}

// Also of inverted elements, whose energy is blended.
TEST(RelaxingSwelling, PowerIsTheRateOfTheEnergyInInvertedElements) {
  const Body body(kMoving);
  Random random(435);
  const Vector q = random_dofs(random, body.s.size(), 0.8), z = body.random_internals(random);
  EXPECT_LT(body.s.model().evaluate("det_f.smallest", {kTime, q, body.s.zero()})[0], 0);
  expect_derivative([&](double h) { return one(body.output("energy.elastic", kTime + h, q, z)); },
                    one(body.output("power.loads", kTime, q, z)));
}

// The force at the end of a history equals the force for the internal variables that the history ends with.
TEST_P(Kinematics, HistoryHasTheForcesOfItsVariables) {
  const Body body(kMoving + with(GetParam()));
  Random random(434);
  const Vector q0 = random_dofs(random, body.s.size(), 0.03), q1 = random_dofs(random, body.s.size(), 0.03),
               z0 = body.random_internals(random);
  HistoryModel model(body.s.model());
  model.begin(kTime - 0.4, q0, z0);
  Vector f(body.s.size());
  model.force(kTime, q1, body.s.zero(), f);
  EXPECT_LE((f - body.force(q1, model.values(kTime, q1))).norm(), 1e-13 * f.norm());
}

// Before a run the body has rested without its loads, or under them at `start: equilibrium`.
TEST(RelaxingSwelling, StartsUnrelaxedUnlessFromEquilibrium) {
  const Body body("moisture: {change: 0.8}\ninitial: {deformation_gradient: [[1.1, 0, 0], [0, 1, 0], [0, 0, 1]]}");
  const State& start = body.s.built.initial;
  EXPECT_GE(start.z.norm(), 0.1);
  EXPECT_LE((start.z - body.total_strains(start.q)).norm(), 1e-15 * start.z.norm());
  const State loaded = initial_state_at(start.q, body.s.scene.initial, 0, body.s.model());
  EXPECT_LE((loaded.z - body.strains(0, start.q)).norm(), 1e-15 * start.z.norm());
  const Vector difference = start.z - loaded.z;
  for (Eigen::Index i = 0; i < difference.size(); i += 6)
    EXPECT_LE((difference.segment<3>(i) - 0.8 * kCoefficients).norm(), 1e-15);
}

// A start other than zero, with a support that has moved before it.
TEST(RelaxingSwelling, StartsWithTheStrainsAtItsOwnTime) {
  const BuiltTestScene s(R"(
mesh: {type: box, size: [1, 0.8, 0.6], cells: [2, 1, 1]}
materials: {m: {type: isotropic, density: 1, young: 1, nu: 0.3, viscoelastic: [{time: 1, share: 0.5}]}}
clamps: [{surface: x0}]
motions: [{surface: x1, translation: [0.1, 0, 0], factor: {type: table, points: [[0, 0], [10, 1], [20, 1]]}}]
initial: {displacement_field: [0.1*x, 0, 0]}
time: {start: 10, end: 12}
)");
  const Vector& z = s.built.initial.z;
  ASSERT_GT(z.size(), 0);
  for (Eigen::Index i = 0; i < z.size(); i += 6) EXPECT_LE((z.segment<6>(i) - 0.1 * Vec6::Unit(0)).norm(), 1e-14) << i;
}

}  // namespace
}  // namespace orthodyn::viscoelastic_swelling_test
