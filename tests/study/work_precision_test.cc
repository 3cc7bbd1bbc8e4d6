// Time to an error and observed order from the points of a method.
#include "lib/study/compare/work_precision.h"

#include <gtest/gtest.h>

#include <cmath>

namespace orthodyn::study::compare::work_precision_test {
namespace {

// error = control^p, time = control^-q
std::vector<WorkPoint> law(double p, double q) {
  std::vector<WorkPoint> points;
  for (const double c : {1e-1, 1e-2, 1e-3, 1e-4}) points.push_back({c, std::pow(c, p), std::pow(c, -q)});
  return points;
}

TEST(WorkPrecision, InterpolateAPowerLawExactly) {
  // error 1e-2 needs control = 1e-2^(1/0.8), time = control^-0.5
  EXPECT_NEAR(*seconds_to_reach(1e-2, law(0.8, 0.5)), std::pow(std::pow(1e-2, 1 / 0.8), -0.5), 1e-12);
}

TEST(WorkPrecision, DoNotExtrapolate) {
  EXPECT_FALSE(seconds_to_reach(1e-5, law(1, 0.5)).has_value());
  EXPECT_NEAR(*seconds_to_reach(0.9, law(1, 0.5)), std::pow(1e-1, -0.5), 1e-12);
  EXPECT_FALSE(seconds_to_reach(1e-1, {}).has_value());
}

TEST(WorkPrecision, CountsARunThatMissesTheErrorByAHair) {
  EXPECT_DOUBLE_EQ(*seconds_to_reach(1e-3, {{1e-3, 1e-2, 1}, {1e-4, 1.024e-3, 2}}), 2);
  EXPECT_FALSE(seconds_to_reach(1e-3, {{1e-3, 1e-2, 1}, {1e-4, 1.1e-3, 2}}));
  EXPECT_EQ(targets({{1e-4, 1.024e-3, 2}}, 0), (std::vector<double>{0.1, 0.01, std::pow(10, -3)}));
}

TEST(WorkPrecision, PreferATighterPointThatHappenedToBeFaster) {
  EXPECT_DOUBLE_EQ(*seconds_to_reach(1e-2, {{1e-2, 5e-3, 4}, {1e-3, 1e-3, 1}}), 1);
}

TEST(WorkPrecision, TheSlopeIsTheExponent) {
  const auto fit = slope(law(0.67, 1));
  ASSERT_TRUE(fit.has_value());
  EXPECT_NEAR(fit->value, 0.67, 1e-12);
  EXPECT_EQ(fit->points, 4);
}

TEST(WorkPrecision, TheSlopeLeavesOutWhatTheReferenceCannotResolveAndWhatFails) {
  auto points = law(1, 1);
  points.push_back({1e-5, 1e-4, 1, false});
  points.insert(points.begin(), WorkPoint{1, 0.9, 1});
  EXPECT_NEAR(slope(points)->value, 1, 1e-12);
  EXPECT_FALSE(slope({points.begin(), points.begin() + 3}).has_value());  // two are left
}

TEST(WorkPrecision, TargetsArePowersOfTenThatSomebodyReaches) {
  const auto list = targets({{1e-3, 2e-3, 1}, {1e-4, 3e-5, 2}}, 1e-4);
  ASSERT_EQ(list.size(), 3u);
  EXPECT_NEAR(list.front(), 1e-1, 1e-15);
  EXPECT_NEAR(list.back(), 1e-3, 1e-15);
}

}  // namespace
}  // namespace orthodyn::study::compare::work_precision_test
