// Prescribed motion: kinematics, effect on the free coordinates, reactions and energy.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <numbers>

#include "lib/fem/differences.h"
#include "lib/fem/motion/support_motion.h"
#include "tests/fem/built_scene.h"
#include "tests/fem/derivatives.h"

namespace orthodyn::motion_test {
namespace {

SupportMotion read_motion(const std::string& yaml) { return SupportMotion::spec().read(Config::from_text(yaml)); }

const std::string kTurnAndShift =
    "{surface: x1, translation: [0.3, -0.2, 0.5], rotation: {point: [1, 0.5, 0], axis: [1, 2, 2], angle: 400 deg}, "
    "factor: {type: smooth_step, end: 2}}";
const std::string kFormulas =
    "{surface: x1, displacement: [0.1*sin(3*t)*y, 0.2*t^2*z, 0.1*x*(cos(2*t) - 1)], resolution: 0.03}";

NodalVector some_points() {
  Random random(320);
  return NodalVector::NullaryExpr(3, 5, [&] { return random.between(-1, 1); });
}

class Motions : public testing::TestWithParam<std::string> {};
INSTANTIATE_TEST_SUITE_P(Kinds, Motions, testing::Values(kTurnAndShift, kFormulas),
                         [](const auto& tested) { return tested.index == 0 ? "rigid" : "formulas"; });

TEST_P(Motions, HaveTheVelocityAndAccelerationOfTheirDisplacements) {
  const auto motion = read_motion(GetParam()).motion(0, 2, some_points());
  const NodalVector X = some_points();
  for (const double t : {0.4, 1.0, 1.7}) {
    const auto displacement = [&](double h) { return Vector(motion->at(t + h, X).u.reshaped()); };
    const auto velocity = [&](double h) { return Vector(motion->at(t + h, X).v.reshaped()); };
    expect_derivative(displacement, motion->at(t, X).v.reshaped());
    expect_derivative(velocity, motion->at(t, X).a.reshaped());
  }
}

// Without `resolution` the difference step must suit fast and slow motions, and a pulse after a long rest.
TEST(FormulaMotion, HasItsRatesAtAnyScaleOfTime) {
  const NodalVector X = some_points();
  for (const double T : {1e-9, 1e-3, 1.0, 1e6}) {
    const double w = 2 * std::numbers::pi / T, width = T / 500;
    const auto sine =
        read_motion(fmt::format("{{surface: x1, displacement: [sin({:.17g}*t), 0, 0]}}", w)).motion(0, 3 * T, X);
    const auto pulse =
        read_motion(fmt::format("{{surface: x1, displacement: [\"exp(-((t - {:.17g})/{:.17g})^2)\", 0, 0]}}", T, width))
            .motion(0, 3 * T, X);
    for (const double share : {0.0, 0.3, 1.0, 2.71}) {
      const Moved moved = sine->at(share * T, X);
      EXPECT_NEAR(moved.v(0, 0) / w, std::cos(w * share * T), 1e-8) << T;
      EXPECT_NEAR(moved.a(0, 0) / (w * w), -std::sin(w * share * T), 1e-8) << T;
    }
    for (const double away : {-300.0, -30.0, -3.0, -1.0, 0.0, 0.4, 2.0, 30.0}) {
      const Moved moved = pulse->at(T + away * width, X);
      const double height = std::exp(-away * away);
      EXPECT_NEAR(moved.v(0, 0) * width, -2 * away * height, 1e-7) << T << " " << away;
      EXPECT_NEAR(moved.a(0, 0) * width * width, (4 * away * away - 2) * height, 1e-6) << T << " " << away;
    }
  }
}

TEST(RigidMotion, KeepsDistancesAndTurnsByTheWholeAngle) {
  const auto motion =
      read_motion(
          "{surface: x1, rotation: {point: [1, 0, 0], axis: [0, 0, 5], angle: 450 deg}, factor: {type: constant}}")
          .motion(0, 2, some_points());
  NodalVector X(3, 2);
  X << 2, 1, 0, 0, 7, -1;
  const Moved moved = motion->at(0, X);
  EXPECT_LE((X.col(0) + moved.u.col(0) - Vec3(1, 1, 7)).norm(), 1e-14);
  EXPECT_LE((X.col(1) + moved.u.col(1) - Vec3(1, 0, -1)).norm(), 1e-14);
  EXPECT_EQ(moved.v.norm() + moved.a.norm(), 0);
}

TEST(RigidMotion, ByASmallAngleHasAllDigits) {
  const auto motion =
      read_motion(
          "{surface: x1, rotation: {point: [0, 0, 0], axis: [0, 0, 1], angle: 1e-9 rad}, factor: {type: constant}}")
          .motion(0, 2, some_points());
  NodalVector X(3, 1);
  X << 3, 4, 0;
  const Vec3 expected(-4e-9 - 1.5e-18, 3e-9 - 2e-18, 0);  // angle x r - angle^2 r/2
  EXPECT_LE((motion->at(0, X).u - expected).norm(), 4 * kEps * 5e-9);
}

TEST(RigidMotion, PassesHalfATurnWithoutAJump) {
  const auto motion = read_motion(kTurnAndShift).motion(0, 2, some_points());
  const NodalVector X = some_points();
  for (double t = 0; t < 2; t += 0.01)
    EXPECT_LE((motion->at(t + 1e-6, X).u - motion->at(t, X).u - 1e-6 * motion->at(t, X).v).norm(), 1e-9) << t;
}

std::string scene(const std::string& rest) {
  return fmt::format(R"(
mesh: {{type: box, size: [2, 1, 1], cells: [3, 1, 1], order: 1}}
materials: {{m: {}}}
regions: {{body: {{material: m, axes: {}}}}}
time: {{end: 2}}
{})",
                     fibre_material(10, 3), kTurnedAxes, rest);
}

struct Setting {
  std::string name, mass, more;
};
void PrintTo(const Setting& s, std::ostream* os) { *os << s.name; }
class MovedBody : public testing::TestWithParam<Setting> {
 protected:
  std::string common() const { return "mass: " + GetParam().mass + "\n" + GetParam().more + "\n"; }
  BuiltTestScene moved() const {
    return BuiltTestScene(scene(common() +
                                "clamps: [{surface: x0, components: [x, y]}]\noutput: {reactions: true}\nmotions:\n"
                                "  - " +
                                kFormulas + "\n"));
  }
  BuiltTestScene all_free() const { return BuiltTestScene(scene(common())); }
};
INSTANTIATE_TEST_SUITE_P(Settings, MovedBody,
                         testing::Values(Setting{"lumped", "lumped", ""}, Setting{"consistent", "consistent", ""},
                                         Setting{"lumped_damped", "lumped", "damping: {mass: 0.7, stiffness: 0.1}"},
                                         Setting{"consistent_damped", "consistent",
                                                 "damping: {mass: 0.7, stiffness: 0.1}\ngravity: [1, 2, 3]"}),
                         [](const auto& tested) { return tested.param.name; });

// The same state of the moved body and of a body whose nodes are all unknowns.
struct Both {
  Both(const BuiltTestScene& moved, const BuiltTestScene& free, Random& random)
      : q(random_dofs(random, moved.size(), 0.05)),
        v(random_dofs(random, moved.size(), 1)),
        nodal(moved.model().parts(), t, q, v),
        a(moved.size()) {
    all_q = (nodal.x - *moved.model().parts().rest).reshaped();
    all_v = nodal.u_rate.reshaped();
    moved.model().force(t, q, v, a);
    moved.model().solve_mass(a);
    NodalVector all = moved.model().parts().moved->accelerations(t);
    moved.model().parts().dofs->add_to(a, all);
    all_a = all.reshaped();
    needed = free.mass() * all_a - free.force(all_q, all_v, t);
  }
  double t = 0.6;
  Vector q, v;
  NodalExpansion nodal;
  Vector a;  // free
  Vector all_q, all_v, all_a;
  Vector needed;  // M a - f of all nodes: what the surroundings must exert
};

TEST_P(MovedBody, MovesAsIfTheSupportsExertedWhatTheirNodesNeed) {
  Random random(321);
  const auto s = moved(), free = all_free();
  const Both both(s, free, random);
  Vector on_free(s.size());
  s.model().parts().dofs->restrict_to(both.needed.reshaped(3, both.needed.size() / 3), on_free);
  EXPECT_LE(on_free.norm(), 1e-12 * both.needed.norm());
}

TEST_P(MovedBody, HasAForceThatIsTheSumOfItsParts) {
  Random random(325);
  const auto s = moved();
  const Vector q = random_dofs(random, s.size(), 0.05), v = random_dofs(random, s.size(), 1),
               whole = s.force(q, v, 0.6);
  Vector sum = s.zero(), f = s.zero();
  for (const auto& part : s.model().force_parts()) {
    s.model().only({part})->force(0.6, q, v, f);
    sum += f;
  }
  EXPECT_LE((sum - whole).norm(), 1e-13 * whole.norm());
}

TEST_P(MovedBody, ReactionsAreWhatItsHeldNodesNeed) {
  Random random(322);
  const auto s = moved(), free = all_free();
  const Both both(s, free, random);
  const NodalVector needed = both.needed.reshaped(3, both.needed.size() / 3);
  const NodalVector& X = *s.model().parts().rest;
  Vec3 left = Vec3::Zero(), right = Vec3::Zero(), torque = Vec3::Zero(), middle = Vec3::Zero();
  for (Eigen::Index i = 0; i < X.cols(); ++i)
    if (X(0, i) == 2) middle += both.nodal.x.col(i) / 4;
  for (Eigen::Index i = 0; i < X.cols(); ++i) {
    if (X(0, i) == 0) left += needed.col(i);
    if (X(0, i) != 2) continue;
    right += needed.col(i);
    torque += (both.nodal.x.col(i) - middle).cross(needed.col(i));
  }
  left[2] = 0;
  const State state{both.t, both.q, both.v};
  const auto vector = [&](const char* name) {
    return Vec3(Eigen::Map<const Vec3>(s.model().evaluate(name, state).data()));
  };
  EXPECT_LE((vector("reaction.clamp_1") - left).norm(), 1e-12 * both.needed.norm());
  EXPECT_LE((vector("reaction.motion_1") - right).norm(), 1e-12 * both.needed.norm());
  EXPECT_LE((vector("torque.motion_1") - torque).norm(), 1e-12 * both.needed.norm());
}

TEST_P(MovedBody, HasTheKineticEnergyAndMomentumOfAllItsNodes) {
  Random random(323);
  const auto s = moved(), free = all_free();
  const Both both(s, free, random);
  const Vector momentum = free.mass() * both.all_v;
  const State state{both.t, both.q, both.v};
  EXPECT_NEAR(s.model().evaluate("energy.kinetic", state)[0], 0.5 * both.all_v.dot(momentum), 1e-13 * momentum.norm());
  const Vec3 sum = momentum.reshaped(3, momentum.size() / 3).rowwise().sum();
  EXPECT_LE((Eigen::Map<const Vec3>(s.model().evaluate("momentum.linear", state).data()) - sum).norm(),
            1e-13 * momentum.norm());
}

TEST_P(MovedBody, GainsTheWorkOfItsSupportsLessWhatIsDissipated) {
  Random random(324);
  const auto s = moved(), free = all_free();
  const Both both(s, free, random);
  const State state{both.t, both.q, both.v};
  const auto energy = [&](double h) {
    const State at{both.t + h, both.q + h * both.v + h * h / 2 * both.a, both.v + h * both.a};
    double sum = 0;
    for (const char* kind : {"energy.kinetic", "energy.elastic", "energy.gravitational"})
      sum += s.model().evaluate(kind, at)[0];
    return one(sum);
  };
  const double power = s.model().evaluate("power.loads", state)[0] - s.model().evaluate("power.dissipated", state)[0];
  expect_derivative(energy, one(power));
  EXPECT_TRUE(s.model().traits().loaded);
  EXPECT_FALSE(s.model().traits().conservative);
}

TEST(MovedBody, IsFreeOfStressWhereAllOfItTurnsWithItsSupport) {
  const BuiltTestScene s(scene("motions:\n  - " + kTurnAndShift));
  const auto motion = read_motion(kTurnAndShift).motion(0, 2, some_points());
  const NodalVector& X = *s.model().parts().rest;
  for (const double t : {0.7, 1.3, 2.0}) {
    const NodalVector u = motion->at(t, X).u;
    Vector q(s.size());
    s.model().parts().dofs->restrict_to(u, q);
    EXPECT_LE(s.force(q, s.zero(), t).norm(), 1e-12) << t;
  }
}

TEST(MovedBody, CanBeMovedInSomeCoordinatesAndClampedInOthers) {
  const BuiltTestScene s(
      scene("clamps: [{surface: x1, components: [y, z]}]\nmotions:\n"
            "  - {surface: x1, components: [x], translation: [0.1, 7, 7], factor: {type: sine, frequency: 0.5}}"));
  const NodalExpansion at(s.model().parts(), 0.25, s.zero(), s.zero());
  const NodalVector& X = *s.model().parts().rest;
  for (Eigen::Index i = 0; i < X.cols(); ++i) {
    const Vec3 expected = X(0, i) == 2 ? Vec3(0.1 * std::sqrt(0.5), 0, 0) : Vec3(0, 0, 0);
    EXPECT_LE((at.x.col(i) - X.col(i) - expected).norm(), 1e-15);
  }
  EXPECT_TRUE(s.model().traits().time_dependent);
}

TEST(MovedBody, WhoseInertiaPullsHasNoForceBetweenTwoStates) {
  for (const char* mass : {"lumped", "consistent"}) {
    const BuiltTestScene s(scene(fmt::format("mass: {}\nmotions:\n  - {}", mass, kTurnAndShift)));
    EXPECT_EQ(s.model().discrete_gradient() != nullptr, s.scene.mass == MassKind::lumped);
  }
}

TEST(MovedBody, StopsAtTheKinksOfItsMotions) {
  const BuiltTestScene s(
      scene("motions:\n  - {surface: x0, translation: [1, 0, 0], factor: {type: ramp, start: 0.5, end: 1}}\n"
            "  - {surface: x1, displacement: [t, 0, 0], kinks: [0.2, 5]}"));
  EXPECT_EQ(s.model().breakpoints(0, 2), (std::vector<double>{0.2, 0.5, 1}));
}

TEST(UnmovedBody, HasNoReactionsUnlessTheyAreAskedFor) {
  const auto count = [](const std::string& rest) {
    const BuiltTestScene s(scene("clamps: [{surface: x0}]\n" + rest));
    const auto outputs = s.model().outputs();
    return std::count_if(outputs.begin(), outputs.end(), [](const auto& o) { return o.name.starts_with("reaction."); });
  };
  EXPECT_EQ(count(""), 0);
  EXPECT_EQ(count("output: {reactions: true}"), 1);
  EXPECT_EQ(count("expect: [{quantity: reaction.clamp_1.x, value: 1, absolute: 1, source: none, reason: none}]"), 1);
}

}  // namespace
}  // namespace orthodyn::motion_test
