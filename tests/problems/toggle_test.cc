// Williams' toggle (Quart. J. Mech. Appl. Math. 17, 1964): two clamped, slightly inclined beams with a rigid joint,
// loaded at the apex, against his beam-column theory.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "lib/mesh/box.h"
#include "lib/mesh/quadratic.h"
#include "lib/simulation/statics/static_problem.h"
#include "tests/fem/built_scene.h"

namespace orthodyn::toggle_test {
namespace {

// Inches and pounds, as published.
constexpr double kHalf = 12.943, kRise = 0.386, kWidth = 0.753, kDepth = 0.243, kYoungs = 1.03e7;
constexpr double kArea = kWidth * kDepth, kBending = kYoungs * kWidth * kDepth * kDepth * kDepth / 12;
constexpr double kSlope = kRise / kHalf;

// One half of the toggle at the apex deflection d. Its shape w satisfies w'' + k^2 w = const + ... and is clamped at
// both ends: w' = d s(x), s = A (1 - cos kx) + B sin kx. N is found by bisection.
struct Half {
  double k;  // 1/in, k^2 = N / (E I)
  double tangent() const { return std::tan(k * kHalf / 2); }
  // for unit deflection: transverse force over E I, and the integral of s^2
  double across() const { return k * k * k / (2 * (k * kHalf / 2 - tangent())); }
  double slope(double x) const {
    const double T = across() / (k * k);  // (1 - cos kx - tan(ka/2) sin kx) T = s
    return T * (1 - std::cos(k * x) - tangent() * std::sin(k * x));
  }
  double square() const {
    constexpr int kParts = 400;
    double sum = 0;
    for (int i = 0; i < kParts; ++i) sum += std::pow(slope((i + 0.5) * kHalf / kParts), 2);
    return sum * kHalf / kParts;
  }
};

// N - E A/a (slope d - d^2/2 int s^2) = 0 in (0, 4 pi^2 E I/a^2).
double theory(double d) {
  const auto missing = [&](double k) {
    return k * k * kBending - kYoungs * kArea / kHalf * (kSlope * d - d * d / 2 * Half{k}.square());
  };
  double low = 1e-3 / kHalf, high = 2 * std::numbers::pi / kHalf * 0.999;
  for (int i = 0; i < 200; ++i) {
    const double middle = 0.5 * (low + high);
    (missing(middle) > 0 ? high : low) = middle;
  }
  const double k = low;
  // P/2 = T + N slope, T = -E I w''' - N w'.
  return 2 * (-kBending * Half{k}.across() * d + k * k * kBending * kSlope);
}

BuiltTestScene toggle(double load) {
  Mesh mesh = make_box({.size = {2 * kHalf, kWidth, kDepth}, .cells = {32, 1, 1}});
  for (Vec3& x : mesh.nodes) x[2] += kRise * (1 - std::abs(x[0] / kHalf - 1));
  make_quadratic(mesh, [&](int a, int b) {
    return Vec3((mesh.nodes[static_cast<std::size_t>(a)] + mesh.nodes[static_cast<std::size_t>(b)]) / 2);
  });
  given_mesh() = mesh;
  return BuiltTestScene(fmt::format(R"(
analysis: static
statics: {{at_limit: follow, first_step: 0.05, max_step: 0.05}}
mesh: {{type: given}}
materials: {{m: {{type: isotropic, density: 1, young: {}, nu: 0}}}}
clamps: [{{surface: x0}}, {{surface: x1}}]
terms: [{{type: point_load, box: {{min: [{}, 0, 0], max: [{}, 1, 1]}}, force: [0, 0, -{}]}}]
)",
                                    kYoungs, kHalf - 1e-3, kHalf + 1e-3, load));
}

TEST(WilliamsToggle, IsTracedThroughItsSnap) {
  const double load = 60;
  const auto scene = toggle(load);
  const StaticProblem problem = static_problem(scene.scene, scene.built);
  const int apex = nearest_node(scene.mesh(), {kHalf, kWidth / 2, kRise + kDepth / 2});
  double largest = 0;
  int points = 0;
  while (!problem.stepper->done()) {
    problem.stepper->step();
    const State& state = problem.stepper->state();
    const double d = -scene.nodal(state.q)(2, apex), P = state.t * load;
    if (d > 0.7) break;
    EXPECT_NEAR(P, theory(d), 0.02 * 34) << "at a deflection of " << d;
    largest = std::max(largest, d);
    ++points;
  }
  EXPECT_GT(largest, 0.5);
  EXPECT_GT(points, 10);
  ASSERT_GE(problem.stepper->critical_points().size(), 2u);
  // Williams measured a largest load of about 34 lb.
  EXPECT_NEAR(problem.stepper->critical_points()[0].load_factor * load, 34, 1);
}

}  // namespace
}  // namespace orthodyn::toggle_test
