// The dense output of one-step methods, by Hermite interpolation.
#include "lib/ode/hermite.h"

#include <gtest/gtest.h>

#include <cmath>

namespace orthodyn::hermite_test {
namespace {

Vector one(double x) { return Vector::Constant(1, x); }

StepEnd on_sine(double t) { return {t, one(std::sin(t)), one(std::cos(t)), one(-std::sin(t))}; }

// The position t^5 - 2 t^3 + t, with its velocity and acceleration.
StepEnd on_quintic(double t) {
  return {t, one(std::pow(t, 5) - 2 * std::pow(t, 3) + t), one(5 * std::pow(t, 4) - 6 * t * t + 1),
          one(20 * std::pow(t, 3) - 12 * t)};
}

StepEnd between(const StepEnd& begin, const StepEnd& end, double t) {
  StepEnd out{t, one(0), one(0), {}};
  interpolate(begin, end, t, out.q, out.v);
  return out;
}

TEST(Hermite, AQuinticIsReproduced) {
  for (const double t : {0.6, 0.9, 1.3, 1.69}) {
    const StepEnd x = between(on_quintic(0.5), on_quintic(1.7), t), exact = on_quintic(t);
    EXPECT_NEAR(x.q[0], exact.q[0], 1e-13);
    EXPECT_NEAR(x.v[0], exact.v[0], 1e-13);
  }
}

TEST(Hermite, TheEndsAreReproducedToTheLastBit) {
  const StepEnd begin = on_sine(0.1), end = on_sine(0.7);
  EXPECT_EQ(between(begin, end, 0.1).q, begin.q);
  EXPECT_EQ(between(begin, end, 0.1).v, begin.v);
  EXPECT_EQ(between(begin, end, 0.7).q, end.q);
  EXPECT_EQ(between(begin, end, 0.7).v, end.v);
}

// Halving the step divides the error of q by 2^6 and that of v by 2^5.
TEST(Hermite, PositionHasOrderSixAndVelocityOrderFive) {
  const auto error = [](double h) {
    const double t = 0.4 + 0.3 * h;
    const StepEnd x = between(on_sine(0.4), on_sine(0.4 + h), t), exact = on_sine(t);
    return std::pair{std::abs(x.q[0] - exact.q[0]), std::abs(x.v[0] - exact.v[0])};
  };
  const auto [q1, v1] = error(0.4);
  const auto [q2, v2] = error(0.2);
  EXPECT_NEAR(std::log2(q1 / q2), 6, 0.3);
  EXPECT_NEAR(std::log2(v1 / v2), 5, 0.3);
}

}  // namespace
}  // namespace orthodyn::hermite_test
