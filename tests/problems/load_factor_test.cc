// The load factor multiplies all loads, including follower loads, together with springs, supports and gravity. Compared
// with the elastica, buckling pressures of rings and arches, and the balance of forces.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "lib/analysis/buckling.h"
#include "lib/analysis/modes.h"
#include "lib/mesh/box.h"
#include "lib/mesh/quadratic.h"
#include "lib/simulation/statics/static_problem.h"
#include "tests/fem/built_scene.h"

namespace orthodyn::load_factor_test {
namespace {

constexpr double kPi = std::numbers::pi;

// A strip clamped at s = 0 under follower pressure p on its upper face. The axis has the angle th and the bending
// moment M = E I th'; F is the force on a cut from the side of the tip. The face is h/2 above the axis: per unit rest
// length of the axis its length is 1 + N/(E A) - th' h/2, which carries the load -p b n.
class Elastica {
 public:
  static constexpr double kWidth = 0.05, kThickness = 0.01, kYoung = 1e9;

  explicit Elastica(double pressure) : load_(pressure * kWidth) {
    double angle = 0, before = at_clamp(0)[0];
    for (constexpr double kLook = 0.02; angle > -7; angle -= kLook) {
      const double after = at_clamp(angle - kLook)[0];
      if (before * after <= 0) {
        solve(angle - kLook, angle);
        return;
      }
      before = after;
    }
    throw std::logic_error("no angle of the tip was found");
  }
  Vec3 tip() const { return {-end_[4] - 1, 0, -end_[5]}; }  // its displacement

 private:
  using Values = Eigen::Matrix<double, 6, 1>;  // th, M, F_x, F_z, and the way from the tip, x and z

  void solve(double low, double high) {
    for (int k = 0; k < 60; ++k) {
      const double middle = (low + high) / 2;
      (at_clamp(low)[0] * at_clamp(middle)[0] <= 0 ? high : low) = middle;
    }
    end_ = at_clamp(low);
  }
  // Integrated from the tip inwards.
  Values slope(const Values& y) const {
    constexpr double kBending = kYoung * kWidth * kThickness * kThickness * kThickness / 12,
                     kAxial = kYoung * kWidth * kThickness;
    const double c = std::cos(y[0]), s = std::sin(y[0]), bend = y[1] / kBending,
                 stretch = 1 + (y[2] * c + y[3] * s) / kAxial, q = load_ * (stretch - kThickness / 2 * bend);
    return {-bend, (-y[2] * s + y[3] * c) * stretch, q * s, -q * c, -stretch * c, -stretch * s};
  }
  Values at_clamp(double angle) const {
    constexpr int kParts = 2000;
    constexpr double h = 1.0 / kParts;
    Values y = Values::Zero();
    y[0] = angle;
    for (int k = 0; k < kParts; ++k) {
      const Values a = slope(y), b = slope(y + h / 2 * a), c = slope(y + h / 2 * b), d = slope(y + h * c);
      y += h / 6 * (a + 2 * b + 2 * c + d);
    }
    return y;
  }

  double load_;
  Values end_;
};

TEST(FollowingPressure, BendsAStripAsTheElastica) {
  for (const double pressure : {100.0, 1500.0, 5000.0, 20000.0}) {
    const BuiltTestScene strip(fmt::format(R"(
analysis: static
mesh: {{type: box, size: [1, {}, {}], cells: [100, 1, 1]}}
materials: {{m: {{type: isotropic, density: 1000, young: {}, nu: 0}}}}
clamps: [{{surface: x0}}]
terms: [{{type: pressure, surface: z1, pressure: {}}}]
)",
                                           Elastica::kWidth, Elastica::kThickness, Elastica::kYoung, pressure));
    const StaticProblem problem = static_problem(strip.scene, strip.built);
    while (!problem.stepper->done()) problem.stepper->step();
    const int tip = nearest_node(strip.mesh(), {1, Elastica::kWidth / 2, Elastica::kThickness / 2});
    const Vec3 moved = strip.nodal(problem.stepper->state().q).col(tip);
    EXPECT_LT((moved - Elastica(pressure).tip()).norm(), 1e-3) << pressure;
    EXPECT_LE(problem.solver->statistics().newton_iterations, 60) << pressure;
    EXPECT_TRUE(problem.stepper->critical_points().empty()) << pressure;
  }
}

// A quarter of a ring of radius 1 between planes of symmetry, fixed along z everywhere, under external pressure.
std::string ring(bool follows, double pressure, const std::string& analysis) {
  constexpr int kAround = 48;
  constexpr double kOuter = 1.01, kInner = 0.99, kDepth = 0.05;
  Mesh mesh = make_box({.size = {1, kDepth, 1}, .cells = {kAround, 1, 1}});
  const auto bent = [&](const Vec3& x) {
    const double r = kInner + (kOuter - kInner) * x[2], angle = kPi / 2 * (1 - x[0]);
    return Vec3(r * std::cos(angle), r * std::sin(angle), -x[1]);
  };
  const Mesh straight = mesh;
  for (Vec3& x : mesh.nodes) x = bent(x);
  make_quadratic(mesh, [&](int a, int b) {
    return bent((straight.nodes[static_cast<std::size_t>(a)] + straight.nodes[static_cast<std::size_t>(b)]) / 2);
  });
  given_mesh() = mesh;
  return fmt::format(R"(
{}
mesh: {{type: given}}
materials: {{m: {{type: isotropic, density: 1, young: 1e9, nu: 0}}}}
clamps:
  - {{surface: x0, components: [x]}}
  - {{surface: x1, components: [y]}}
  - {{box: {{min: [-1, -1, -1], max: [2, 2, 1]}}, components: [z]}}
terms: [{{type: pressure, surface: z1, pressure: {}, follows: {}}}]
time: {{end: 1}}
)",
                     analysis, pressure, follows);
}

// Critical pressure of an inextensible ring with axis radius 1. Follower pressure on the outside, r = 1 + h/2, has the
// potential p times the enclosed area, which equals the area within the axis plus a constant: p = 3 E I (Bresse 1866).
// With a fixed direction, the force p r per unit angle moves inwards by (1/2 + h/4) th^2 for a section rotation th,
// instead of th^2/2: p r (1 + h/2) = 4 E I (Boresi 1955, for a force on the axis).
double critical_pressure(bool follows) {
  constexpr double kBending = 1e9 * 0.02 * 0.02 * 0.02 / 12, kOuter = 1.01;
  return follows ? 3 * kBending : 4 * kBending / (kOuter * kOuter);
}

TEST(Ring, BucklesAtTheOnePressureThatFollowsItAndTheOtherThatDoesNot) {
  for (const bool follows : {true, false}) {
    const double expected = critical_pressure(follows);
    const BuiltTestScene linear(ring(follows, 1, "analysis: buckling"));
    const BucklingModes modes = buckling_modes(linear.model(), linear.zero(), 1, 1);
    ASSERT_EQ(modes.modes.size(), 1u);
    EXPECT_NEAR(modes.modes[0].load_factor, expected, 0.001 * expected) << follows;

    const BuiltTestScene scene(ring(follows, 1.5 * expected, "analysis: static"));
    const StaticProblem problem = static_problem(scene.scene, scene.built);
    try {
      while (!problem.stepper->done()) problem.stepper->step();
      ADD_FAILURE() << "no critical point, " << follows;
    } catch (const RunError&) {
      ASSERT_EQ(problem.stepper->critical_points().size(), 1u);
      const CriticalPoint& point = problem.stepper->critical_points()[0];
      EXPECT_EQ(point.kind, CriticalPoint::Kind::bifurcation);
      EXPECT_NEAR(1.5 * expected * point.load_factor, expected, 0.001 * expected) << follows;
    }
  }
}

TEST(Ring, HasModesAboutRestThatNoPressureChanges) {
  const auto lowest = [](double pressure, double load_factor) {
    const BuiltTestScene s(ring(true, pressure, "analysis: static"));
    return natural_modes(s.model(), {1, s.zero(), s.zero(), load_factor}, 1).modes[0].frequency();
  };
  const double pressure = critical_pressure(true) / 2, without = lowest(0, 0);
  EXPECT_NEAR(lowest(pressure, 0), without, 1e-9 * without);
  EXPECT_GT(std::abs(lowest(pressure, 1) - without), 1e-3 * without);  // a spring to leave out
}

// A shallow arch between clamps under follower pressure on its upper side.
double limit_pressure(double asked, bool follows) {
  constexpr double kRise = 0.04, kDepth = 0.02;
  Mesh mesh = make_box({.size = {1, 0.05, kDepth}, .cells = {24, 1, 1}});
  for (Vec3& x : mesh.nodes) x[2] += kRise * std::sin(kPi * x[0]);
  make_quadratic(mesh, [&](int a, int b) {
    return Vec3((mesh.nodes[static_cast<std::size_t>(a)] + mesh.nodes[static_cast<std::size_t>(b)]) / 2);
  });
  given_mesh() = mesh;
  const BuiltTestScene arch(fmt::format(R"(
analysis: static
mesh: {{type: given}}
materials: {{m: {{type: isotropic, density: 1, young: 1e9, nu: 0}}}}
clamps: [{{surface: x0}}, {{surface: x1}}]
terms: [{{type: pressure, surface: z1, pressure: {}, follows: {}}}]
statics: {{solver: {{type: kinsol, rtol: 1e-10}}}}
)",
                                        asked, follows));
  const StaticProblem problem = static_problem(arch.scene, arch.built);
  try {
    while (!problem.stepper->done()) problem.stepper->step();
  } catch (const RunError&) {
  }
  const auto& points = problem.stepper->critical_points();
  return points.empty() || points[0].kind != CriticalPoint::Kind::limit ? 0 : points[0].load_factor * asked;
}

TEST(ShallowArch, HasOneLimitPressureWhateverPressureIsAskedFor) {
  for (const bool follows : {true, false}) {
    const double first = limit_pressure(4e4, follows);
    EXPECT_GT(first, 0);
    for (const double asked : {5e4, 7e4, 2e5})
      EXPECT_NEAR(limit_pressure(asked, follows), first, 1e-6 * first) << asked;
  }
}

// Every state of a path is an equilibrium of springs, supports and the loads times the load factor. The path begins at
// the equilibrium with the springs only.
TEST(LoadFactor, IsThatOfEachEquilibriumBesideSpringsAndMovedSupports) {
  const BuiltTestScene beam(R"(
analysis: static
mesh: {type: box, size: [1, 0.1, 0.1], cells: [6, 1, 1]}
materials: {m: {type: isotropic, density: 1000, young: 1e7, nu: 0.3}}
clamps: [{surface: x0, name: wall}]
motions: [{surface: x1, translation: [0, 0.05, 0], components: [y], factor: {type: ramp, end: 1}}]
gravity: [0, 0, -10]
terms:
  - {type: pressure, surface: z1, pressure: 200}
  - {type: spring, surface: x1, stiffness: 50, anchor: [1, 0, 1], rest_length: 0.5}
output: {reactions: true}
time: {end: 1}
)");
  const StaticProblem problem = static_problem(beam.scene, beam.built);
  const FemModel& model = beam.model();
  const auto loads = model.load_parts().value();
  auto structure = model.force_parts();
  std::erase_if(structure, [&](const std::string& part) { return std::ranges::find(loads, part) != loads.end(); });
  ASSERT_EQ(loads.size(), 2u);
  const auto push = model.only(loads), hold = model.only(structure);
  const auto unbalanced = [&](const State& s) {
    Vector f(s.q.size()), l(s.q.size());
    hold->force(s.t, s.q, beam.zero(), f);  // supports move from t = 0 to 1, as the load factor does
    push->force(s.t, s.q, beam.zero(), l);
    return (f + s.t * l).lpNorm<Eigen::Infinity>();
  };
  const double tolerance = 1e-6 * problem.path->largest_load();
  EXPECT_GT(problem.stepper->state().q.lpNorm<Eigen::Infinity>(), 1e-3);  // pulled up by the spring
  EXPECT_LT(unbalanced(problem.stepper->state()), tolerance);
  while (!problem.stepper->done()) {
    problem.stepper->step();
    EXPECT_LT(unbalanced(problem.stepper->state()), tolerance) << problem.stepper->state().t;
    EXPECT_LT(problem.path->evaluate("imbalance", problem.stepper->state())[0], 2 * tolerance);
  }
  EXPECT_GE(problem.stepper->steps(), 2);
}

// A column whose end is pulled by a spring against the load: the load factor does not multiply the spring.
TEST(LoadFactor, OfBucklingDoesNotMultiplyAStretchedSpring) {
  const auto column = [](double tension) {
    constexpr double kStiffness = 1e-3;
    return fmt::format(R"(
analysis: buckling
mesh: {{type: box, size: [1, 0.05, 0.01], cells: [44, 1, 2]}}
materials: {{m: {{type: isotropic, density: 1000, young: 1e9, nu: 0}}}}
clamps: [{{surface: x0}}, {{surface: x1, components: [y, z]}}]
loads: [{{surface: x1, force: [-1, 0, 0]}}]
terms: [{{type: spring, surface: x1, stiffness: {}, anchor: [1e5, 0.025, 0.005], rest_length: {}}}]
time: {{end: 1}}
)",
                       kStiffness, 99999 - tension / kStiffness);
  };
  const auto factor = [&](double tension) {
    const BuiltTestScene scene(column(tension));
    return buckling_modes(scene.model(), unloaded_shape(scene.scene, scene.built), 1, 1).modes.at(0).load_factor;
  };
  const double without = factor(0);
  for (const double tension : {5.0, 20.0}) EXPECT_NEAR(factor(tension), without + tension, 0.01 * without) << tension;
}

}  // namespace
}  // namespace orthodyn::load_factor_test
