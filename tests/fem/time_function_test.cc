// Time functions: values, rates, kinks.
#include "lib/fem/time_functions/time_function.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "lib/core/errors.h"
#include "lib/fem/differences.h"

namespace orthodyn::time_function_test {
namespace {

std::shared_ptr<const TimeFunction> factor(const std::string& yaml) {
  return Registry<TimeFunction>::read(Config::from_text(yaml));
}

TEST(TimeFunction, ConstantIsConstant) {
  const auto f = factor("{type: constant, value: -2}");
  EXPECT_EQ(f->value(-1), -2);
  EXPECT_EQ(f->value(1e9), -2);
  EXPECT_TRUE(f->constant());
  EXPECT_TRUE(f->kinks().empty());
  EXPECT_EQ(f->peak(0, 1), 2);
}

TEST(TimeFunction, FormulaHasItsRatesOverASpanOfAnyLength) {
  for (const double T : {1e-9, 1.0, 1e6}) {
    const double w = 2 * std::numbers::pi / T;
    const auto f = factor(fmt::format("{{type: expression, formula: sin({:.17g}*t)}}", w))->over(0, 3 * T);
    ASSERT_NE(f, nullptr);
    EXPECT_NEAR(f->rate(0.3 * T) / w, std::cos(w * 0.3 * T), 1e-8) << T;
    EXPECT_NEAR(f->curvature(0.3 * T) / (w * w), -std::sin(w * 0.3 * T), 1e-8) << T;
  }
}

TEST(TimeFunction, RampRisesBetweenItsKinks) {
  const auto f = factor("{type: ramp, start: 1, end: 3, value: -4}");
  for (const auto& [t, expected] : {std::pair{0.0, 0.0}, {1.0, 0.0}, {1.5, -1.0}, {3.0, -4.0}, {9.0, -4.0}})
    EXPECT_EQ(f->value(t), expected) << t;
  EXPECT_EQ(f->kinks(), (std::vector<double>{1, 3}));
  EXPECT_EQ(f->peak(0, 1), 4);
  EXPECT_FALSE(f->constant());
}

TEST(TimeFunction, SineHasFrequencyAmplitudeAndPhase) {
  const auto f = factor("{type: sine, frequency: 2, amplitude: 3, phase: 0.5 rad}");
  EXPECT_NEAR(f->value(0.3), 3 * std::sin(2 * std::numbers::pi * 2 * 0.3 + 0.5), 1e-14);
  EXPECT_TRUE(f->kinks().empty());
  EXPECT_EQ(f->peak(0, 1), 3);
}

TEST(TimeFunction, TableIsLinearBetweenItsPointsAndConstantBeyond) {
  const auto f = factor("{type: table, points: [[1, 2], [2, -6], [4, 0]]}");
  for (const auto& [t, expected] :
       {std::pair{0.0, 2.0}, {1.0, 2.0}, {1.25, 0.0}, {2.0, -6.0}, {3.0, -3.0}, {4.0, 0.0}, {7.0, 0.0}})
    EXPECT_EQ(f->value(t), expected) << t;
  EXPECT_EQ(f->kinks(), (std::vector<double>{1, 2, 4}));
  EXPECT_EQ(f->peak(0, 1), 6);
}

TEST(TimeFunction, RefusesTimesThatDoNotAscend) {
  EXPECT_THROW(factor("{type: table, points: [[1, 2], [1, 3]]}"), ConfigError);
  EXPECT_THROW(factor("{type: table, points: []}"), ConfigError);
  EXPECT_THROW(factor("{type: ramp, start: 1, end: 1}"), ConfigError);
}

TEST(TimeFunction, SmoothStepRisesFromZeroToItsValueWithVanishingRates) {
  const auto f = factor("{type: smooth_step, start: 1, end: 3, value: -4}");
  for (const auto& [t, expected] : {std::pair{0.0, 0.0}, {1.0, 0.0}, {2.0, -2.0}, {3.0, -4.0}, {9.0, -4.0}})
    EXPECT_NEAR(f->value(t), expected, 1e-15) << t;
  for (const double t : {0.0, 1.0, 3.0, 4.0}) {
    EXPECT_EQ(f->rate(t), 0) << t;
    EXPECT_EQ(f->curvature(t), 0) << t;
  }
  EXPECT_NEAR(f->rate(2), -4 / 2.0 * 15 / 8, 1e-14);  // 30/16 of the mean
  EXPECT_EQ(f->kinks(), (std::vector<double>{1, 3}));
  EXPECT_TRUE(f->has_continuous_rate());
  EXPECT_EQ(f->peak(0, 1), 4);
}

TEST(TimeFunction, ExpressionIsItsFormula) {
  const auto f = factor("{type: expression, formula: 3*t^2 + sin(t), kinks: [0.5], peak: 7}");
  EXPECT_NEAR(f->value(0.3), 3 * 0.09 + std::sin(0.3), 1e-15);
  EXPECT_EQ(f->kinks(), std::vector<double>{0.5});
  EXPECT_FALSE(f->has_continuous_rate());
  EXPECT_EQ(f->peak(0, 1), 7);
  EXPECT_FALSE(f->constant());
}

TEST(TimeFunction, AnExpressionsPeakIsThatOfTheTimeSpan) {
  EXPECT_NEAR(factor("{type: expression, formula: 1e-4*sin(20*t)}")->peak(0, 1), 1e-4, 1e-8);
  EXPECT_EQ(factor("{type: expression, formula: -3*t}")->peak(1, 2), 6);
  EXPECT_NEAR(factor("{type: expression, formula: 2*sqrt(0.5-t)}")->peak(0, 1), std::sqrt(2), 1e-12);  // NaN later
  EXPECT_NEAR(factor("{type: expression, formula: sin(2*pi*50*t)}")->peak(0, 10), 1, 1e-3);
}

TEST(TimeFunction, ExpressionThatHasNoValueSaysWhereAndWhen) {
  const auto f = factor("{type: expression, formula: sqrt(1 - t)}");
  try {
    f->value(2);
    FAIL();
  } catch (const ConfigError& e) {
    const std::string message = e.what();
    for (const char* part : {"formula", "sqrt(1 - t)", "t = 2"})
      EXPECT_NE(message.find(part), std::string::npos) << message;
  }
  EXPECT_THROW(factor("{type: expression, formula: x + t}"), ConfigError);
}

class SmoothFactor : public testing::TestWithParam<std::string> {};
INSTANTIATE_TEST_SUITE_P(Kinds, SmoothFactor,
                         testing::Values("{type: constant, value: 3}", "{type: ramp, end: 2, value: 3}",
                                         "{type: smooth_step, start: -1, end: 2, value: 3}",
                                         "{type: sine, frequency: 0.3, amplitude: 2, phase: 0.4 rad}",
                                         "{type: table, points: [[0, 1], [1, 4], [3, -2]]}",
                                         "{type: expression, formula: exp(-t)*t^3}"));

TEST_P(SmoothFactor, HasTheRateAndCurvatureOfItsValue) {
  const auto f = factor(GetParam());
  for (const double t : {0.1, 0.9, 1.7, 2.5}) {
    const auto d = smooth_differences<double>([&](double s) { return f->value(s); }, t, 0.01, f->kinks());
    EXPECT_NEAR(f->rate(t), d.first, 1e-10) << t;
    EXPECT_NEAR(f->curvature(t), d.second, 1e-7) << t;
  }
}

}  // namespace
}  // namespace orthodyn::time_function_test
