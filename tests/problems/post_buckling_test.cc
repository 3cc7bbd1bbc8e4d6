// A column that is pressed beyond Euler's load, against the elastica (Timoshenko & Gere, Theory of Elastic Stability,
// 1961, 2.7): with k = sin(alpha/2), alpha the slope of its top, P/P_cr = (2 K(k)/pi)^2, its top at
// x/L = 2 E(k)/K(k) - 1, y/L = 2 k/K(k). Pushed across its axis (Bisshopp & Drucker, Quart. Appl. Math. 3, 1945): with
// sin(theta) = 1/(k sqrt(2)), P L^2/(E I) = (K(k) - F(k, theta))^2 = a^2, its end at 1 - 2 (E(k) - E(k, theta))/a.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "lib/simulation/statics/static_problem.h"
#include "tests/fem/built_scene.h"

namespace orthodyn::post_buckling_test {
namespace {

struct Elastica {
  double load, x, y;  // of Euler's load and of the length
};

Elastica elastica(double degrees) {
  const double k = std::sin(degrees * std::numbers::pi / 360), K = std::comp_ellint_1(k);
  return {std::pow(2 * K / std::numbers::pi, 2), 2 * std::comp_ellint_2(k) / K - 1, 2 * k / K};
}

// Transverse end displacement of a column of unit length under P = a^2 E I.
double pushed_across(double a) {
  const auto theta = [](double k) { return std::asin(std::min(1 / (k * std::numbers::sqrt2), 1.0)); };
  double low = 1 / std::numbers::sqrt2, high = 1 - 1e-12;
  while (high - low > 1e-10) {
    const double k = 0.5 * (low + high);
    (std::comp_ellint_1(k) - std::ellint_1(k, theta(k)) < a ? low : high) = k;
  }
  return 1 - 2 * (std::comp_ellint_2(low) - std::ellint_2(low, theta(low))) / a;
}

class Column {
 public:
  // Compressed by `times` Euler's load, with a transverse load of a fraction of it.
  Column(double times, double aside, const std::string& statics)
      : scene_(fmt::format(R"(
analysis: static
statics: {}
mesh: {{type: box, size: [1, 0.05, 0.01], cells: [40, 2, 1]}}
materials: {{m: {{type: isotropic, density: 1000, young: 1e9, nu: 0}}}}
clamps: [{{surface: x0}}]
loads: [{{surface: x1, force: [{}, 0, {}]}}]
)",
                           statics, -times * kEuler, times * aside * kEuler)),
        problem_(static_problem(scene_.scene, scene_.built)) {}

  // The displacement of the middle of its top.
  Vec3 press() {
    while (!problem_.stepper->done()) problem_.stepper->step();
    const int top = nearest_node(scene_.mesh(), {1, 0.025, 0.005});
    return scene_.nodal(problem_.stepper->state().q).col(top);
  }
  const LoadStepper& stepper() const { return *problem_.stepper; }
  long factorizations() const { return problem_.solver->statistics().factorization.count; }
  // Linear solves per step that is easy enough to double the next: four iterations and one for the tangent.
  long few_factorizations() const { return 5 * (stepper().steps() + stepper().rejected()); }

 private:
  static constexpr double kEuler = std::numbers::pi * std::numbers::pi / 4 * 1e9 * 0.05 * 1e-6 / 12;
  BuiltTestScene scene_;
  StaticProblem problem_;
};

TEST(PressedColumn, BendsLikeTheElastica) {
  for (const double degrees : {60.0, 120.0, 160.0}) {
    const Elastica expected = elastica(degrees);
    Column column(expected.load, 1e-3, "{}");
    const Vec3 moved = column.press();
    EXPECT_NEAR(1 + moved[0], expected.x, 0.01) << degrees;
    EXPECT_NEAR(moved[2], expected.y, 0.01) << degrees;
    EXPECT_LE(column.factorizations(), column.few_factorizations()) << degrees;
    ASSERT_EQ(column.stepper().critical_points().size(), 1u);
    EXPECT_EQ(column.stepper().critical_points()[0].kind, CriticalPoint::Kind::turn);
    EXPECT_NEAR(column.stepper().critical_points()[0].load_factor * expected.load, 1, 0.1);
  }
}

// Straight up to Euler's load, then buckled to either side.
TEST(PressedColumn, LeavesTheStraightPathWhereEulerSays) {
  const Elastica expected = elastica(120);
  Column column(expected.load, 0, "{at_limit: jump}");
  const Vec3 moved = column.press();
  EXPECT_NEAR(1 + moved[0], expected.x, 0.01);
  EXPECT_NEAR(std::abs(moved[2]), expected.y, 0.01);
  ASSERT_EQ(column.stepper().critical_points().size(), 1u);
  EXPECT_EQ(column.stepper().critical_points()[0].kind, CriticalPoint::Kind::bifurcation);
  EXPECT_NEAR(column.stepper().critical_points()[0].load_factor * expected.load, 1, 0.005);
  EXPECT_EQ(column.stepper().unstable(), 0);
}

// The first step off the straight path is a 500th of the length (2 % of the motion's size, a tenth of the length). Nine
// doublings reach the full length; four more steps lead up to Euler's load, off the path and to the full load, and two
// are allowed for steps that do not double. The bifurcation is bracketed to a thousandth of the step that passed it:
// ten halvings.
constexpr long kMostSteps = 9 + 4 + 2, kClosingIn = 10 * 5;

// Switches to the path that crosses the straight one.
TEST(PressedColumn, BucklesUnderAnyLoadBeyondEulers) {
  for (const double times : {1.01, 1.1, 1.5, 2.0, 3.0, 5.0, 8.0}) {
    Column column(times, 0, "{at_limit: jump}");
    const Vec3 moved = column.press();
    double low = 0, high = 179;  // slope at the top, degrees
    while (high - low > 1e-9) (elastica(0.5 * (low + high)).load < times ? low : high) = 0.5 * (low + high);
    const Elastica expected = elastica(low);
    EXPECT_NEAR(1 + moved[0], expected.x, 0.02) << times;
    EXPECT_NEAR(std::abs(moved[2]), expected.y, 0.02) << times;
    EXPECT_EQ(column.stepper().jumps(), 1) << times;
    EXPECT_EQ(column.stepper().unstable(), 0) << times;
    EXPECT_LE(column.stepper().steps(), kMostSteps) << times;
    EXPECT_LE(column.factorizations(), column.few_factorizations() + kClosingIn) << times;
  }
}

// The unsymmetric mesh is an imperfection: instead of a bifurcation, the path bends away from the straight path of
// unstable equilibria, for any step size.
TEST(PressedColumn, ThatIsNotQuiteStraightTurnsAsideWhateverTheSteps) {
  const std::string wood = "{type: preset, name: sitka_spruce, density: 400 kg/m^3}";
  for (const std::string statics : {"{}", "{first_step: 0.05, max_step: 0.05}", "{first_step: 1}", "{max_step: 0.3}",
                                    "{at_limit: follow}", "{at_limit: jump}"}) {
    BuiltTestScene scene(fmt::format(R"(
analysis: static
statics: {}
mesh: {{type: box, size: [1, 0.05, 0.01], cells: [40, 2, 1]}}
materials: {{m: {}}}
clamps: [{{surface: x0}}]
loads: [{{surface: x1, force: [-200, 0, 0]}}]
)",
                                     statics, wood));
    const StaticProblem problem = static_problem(scene.scene, scene.built);
    while (!problem.stepper->done()) problem.stepper->step();
    EXPECT_NEAR(problem.stepper->state().q.lpNorm<Eigen::Infinity>(), 0.81, 0.001) << statics;
    ASSERT_EQ(problem.stepper->critical_points().size(), 1u) << statics;
    const CriticalPoint& turn = problem.stepper->critical_points()[0];
    EXPECT_EQ(turn.kind, CriticalPoint::Kind::turn) << statics;
    EXPECT_NEAR(turn.load_factor, 0.6108, std::max(0.005, turn.uncertainty)) << statics;  // Euler: 122.1 N
    EXPECT_LE(turn.uncertainty, 0.1) << statics;
  }
}

// 6,000 unknowns. The elastica neglects shear, which adds at most P/(5/6 G A) = 1.3e-3. The required limit is 60
// tangents for static analyses of slender bodies.
TEST(PushedColumn, BendsLikeTheElasticaInFewTangents) {
  BuiltTestScene scene(R"(
analysis: static
mesh: {type: box, size: [1, 0.05, 0.01], cells: [40, 2, 2]}
materials: {wood: {type: preset, name: sitka_spruce, density: 400}}
clamps: [{surface: x0}]
loads: [{surface: x1, force: [0, 0, -400]}]
)");
  const StaticProblem problem = static_problem(scene.scene, scene.built);
  while (!problem.stepper->done()) problem.stepper->step();
  const int end = nearest_node(scene.mesh(), {1, 0.025, 0.005});
  const double bending = 11.88e9 * 0.05 * 1e-6 / 12;  // the preset's modulus along the grain
  EXPECT_NEAR(-scene.nodal(problem.stepper->state().q)(2, end), pushed_across(std::sqrt(400 / bending)), 1.3e-3);
  EXPECT_LE(problem.solver->statistics().tangent.count, 60);
}

}  // namespace
}  // namespace orthodyn::post_buckling_test
