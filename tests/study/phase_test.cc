// The dominant oscillation of signals with known components.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "lib/simulation/error_estimate/dominant_frequency.h"

namespace orthodyn::phase_test {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr int kSamples = 201;
constexpr double kInterval = 0.01;

Vector wave(double hertz, double amplitude, double phase, double mean = 0) {
  Vector s(kSamples);
  for (int k = 0; k < kSamples; ++k) s[k] = mean + amplitude * std::cos(2 * kPi * hertz * kInterval * k + phase);
  return s;
}

TEST(Phase, FindsTheStrongerOfTwoOscillations) {
  const auto omega = dominant_frequency(wave(4.3, 1, 0.2, 7) + wave(11, 0.3, 1), kInterval);
  ASSERT_TRUE(omega.has_value());
  EXPECT_NEAR(*omega / (2 * kPi), 4.3, 0.01);
}

TEST(Phase, ASlowSwayIsNoOscillation) {
  EXPECT_FALSE(dominant_frequency(wave(0.3, 1, 0), kInterval).has_value());
  EXPECT_FALSE(dominant_frequency(Vector::Constant(kSamples, 2), kInterval).has_value());
}

TEST(Phase, MeasuresTheShiftBetweenTwoSignals) {
  for (const double shift : {0.01, -0.4, 3.0})
    EXPECT_NEAR(phase_difference(wave(5, 2, 0.3 + shift), wave(5, 1, 0.3, 4), 2 * kPi * 5, kInterval), std::abs(shift),
                2e-3);
}

}  // namespace
}  // namespace orthodyn::phase_test
