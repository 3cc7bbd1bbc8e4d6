// Step limits derived from a function of time, so that steps resolve its variation.
#include "lib/ode/step_limits.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include "lib/core/errors.h"

namespace orthodyn::step_limits_test {
namespace {

const double kInfinite = std::numeric_limits<double>::infinity();

// End times of the longest steps allowed.
std::vector<double> longest_steps(const StepLimits& limits, double start, double end) {
  std::vector<double> ends;
  for (double t = start; t < end;) ends.push_back(t = std::min(end, limits.latest_end(t)));
  return ends;
}

TEST(StepLimits, AreNoneForCubics) {
  const auto limits = StepLimits::of([](double t) { return 1 + t * (2 - t * (3 + t)); }, -1, 5, {});
  EXPECT_EQ(limits.latest_end(0), kInfinite);
  EXPECT_FALSE(limits.unresolved());
  EXPECT_EQ(StepLimits().latest_end(3), kInfinite);
}

TEST(StepLimits, AreNoneForRoundOff) {
  const auto one = [](double t) { return std::pow(std::sin(t), 2) + std::pow(std::cos(t), 2); };
  const auto limits = StepLimits::of(one, 0, 100, {});
  EXPECT_EQ(limits.latest_end(0), kInfinite);
  EXPECT_FALSE(limits.unresolved());
}

TEST(StepLimits, LetNoStepPassOverAPulse) {
  const double at = 6.0123, width = 1e-3;
  for (const double height : {1.0, -1e-3}) {  // added to a constant of 1
    const auto pulse = [&](double t) { return 1 + height * std::exp(-std::pow((t - at) / width, 2)); };
    const auto limits = StepLimits::of(pulse, 0, 10, {});
    const auto ends = longest_steps(limits, 0, 10);
    const auto within = std::count_if(ends.begin(), ends.end(), [&](double t) { return std::abs(t - at) < width; });
    EXPECT_GE(within, 2) << height;
    EXPECT_LT(ends.size(), 100u) << height;
    EXPECT_FALSE(limits.unresolved());
  }
}

TEST(StepLimits, DivideAnOscillationByItsPeriod) {
  const double period = 0.37;
  const auto limits = StepLimits::of([&](double t) { return std::sin(2 * std::numbers::pi * t / period); }, 0, 20, {});
  for (const double t : {0.0, 3.3, 11.1, 19.0}) {
    EXPECT_LT(limits.latest_end(t) - t, period / 2);
    EXPECT_GT(limits.latest_end(t) - t, period / 10);
  }
}

TEST(StepLimits, KnowAJumpThatIsNoKink) {
  const auto jump = [](double t) { return t < 0.3 ? 0.0 : 1.0; };
  const auto unresolved = StepLimits::of(jump, 0, 1, {}).unresolved();
  ASSERT_TRUE(unresolved);
  EXPECT_NEAR(*unresolved, 0.3, 1e-4);
  const auto told = StepLimits::of(jump, 0, 1, {0.3});
  EXPECT_FALSE(told.unresolved());
  EXPECT_EQ(told.latest_end(0), kInfinite);
}

TEST(StepLimits, TakeAKinkForNoJump) {
  const double width = 2.5e-3;  // of a half sine that starts and ends between samples
  for (const double begin : {0.0, 0.3001234}) {
    const auto half_sine = [&](double t) {
      return t > begin && t < begin + width ? std::sin(std::numbers::pi * (t - begin) / width) : 0;
    };
    const auto limits = StepLimits::of(half_sine, 0, 1, {});
    EXPECT_FALSE(limits.unresolved()) << *limits.unresolved();
    const auto ends = longest_steps(limits, 0, 1);
    EXPECT_TRUE(std::ranges::any_of(ends, [&](double t) { return t > begin && t < begin + width; }));
  }
  // Lies between two samples.
  const auto triangle = [](double t) { return std::max(0.0, 1 - std::abs(t - 0.3) / 1e-5); };
  EXPECT_TRUE(StepLimits::of(triangle, 0, 1, {}).unresolved());
}

TEST(StepLimits, KnowAnOscillationThatIsTooFastToBeSampled) {
  EXPECT_TRUE(StepLimits::of([](double t) { return std::sin(1e6 * t); }, 0, 1, {}).unresolved());
  EXPECT_FALSE(StepLimits::of([](double t) { return std::sin(1e4 * t); }, 0, 1, {}).unresolved());
}

TEST(StepLimits, AddedHoldTogether) {
  StepLimits limits(0.5);
  limits.add(StepLimits(2));
  EXPECT_EQ(limits.latest_end(1), 1.5);
  limits.add(StepLimits::of([](double t) { return std::sin(100 * t); }, 0, 1, {}));
  EXPECT_LT(limits.latest_end(0.5), 0.55);
  EXPECT_EQ(limits.latest_end(2), 2.5);
}

TEST(StepLimits, PassOverWhatHasNoValue) {
  const auto undefined = [](double t) -> double {
    if (t < 0.5) throw ConfigError("no value");
    return t;
  };
  EXPECT_NO_THROW(StepLimits::of(undefined, 0, 1, {}));
  EXPECT_EQ(StepLimits::of(undefined, 1, 1, {}).latest_end(0), kInfinite);
}

}  // namespace
}  // namespace orthodyn::step_limits_test
