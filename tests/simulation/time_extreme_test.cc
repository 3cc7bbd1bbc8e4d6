// The search for the largest value of a function that is known on one step after the other.
#include "lib/simulation/output/time_extreme.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

namespace orthodyn::time_extreme_test {
namespace {

TimeExtreme search(const TimeExtreme::Function& f, const std::vector<double>& times) {
  TimeExtreme found;
  found.start(times[0], f(times[0]));
  for (std::size_t k = 1; k < times.size(); ++k) found.advance(times[k - 1], times[k], f);
  return found;
}

std::vector<double> even(double end, int steps) {
  std::vector<double> times;
  for (int k = 0; k <= steps; ++k) times.push_back(end * k / steps);
  return times;
}

constexpr double kPi = std::numbers::pi;
double vibration(double t) { return std::exp(-0.3 * t) * std::sin(t); }
const double kPeak = std::atan(1 / 0.3);  // of the vibration

TEST(TimeExtreme, IsFoundWhereverStepsEnd) {
  // Steps that end at the peak, just before and after it, and elsewhere.
  for (const double at : {0.4, kPeak - 1e-9, kPeak, kPeak + 1e-9, kPeak + 0.1}) {
    const TimeExtreme found = search(vibration, {0, 0.3, at, at + 0.5, 2.5, 3, 4, 5, 6, 7, 8, 9, 10});
    EXPECT_NEAR(found.largest().t, kPeak, 1e-6) << at;
    EXPECT_NEAR(found.largest().value, vibration(kPeak), 1e-12) << at;
    EXPECT_FALSE(found.ends_run() || found.largest().jumps) << at;
    EXPECT_NEAR(found.next().t, kPeak + 2 * kPi, 1e-6) << at;  // each maximum counts once
    EXPECT_GE(found.range(), vibration(kPeak) - vibration(kPeak + kPi) - 0.01) << at;
  }
}

TEST(TimeExtreme, AtTheEndsOfTheRun) {
  const TimeExtreme falls = search([](double t) { return -t; }, even(1, 3));
  EXPECT_EQ(falls.largest().t, 0);
  EXPECT_FALSE(falls.ends_run());
  const TimeExtreme rises = search([](double t) { return t * t; }, even(1, 3));
  EXPECT_EQ(rises.largest().t, 1);
  EXPECT_EQ(rises.largest().value, 1);
  EXPECT_TRUE(rises.ends_run());
  EXPECT_FALSE(rises.next().exists());
  const TimeExtreme rises_again = search([](double t) { return std::cos(t) + 0.2 * t; }, even(6, 12));
  EXPECT_EQ(rises_again.largest().t, 6);
  EXPECT_NEAR(rises_again.next().t, std::asin(0.2), 1e-6);
}

TEST(TimeExtreme, EqualMaximaAreBothFound) {
  const TimeExtreme found = search([](double t) { return std::sin(t); }, even(9, 40));
  EXPECT_NEAR(found.largest().value, found.next().value, 1e-12);
  EXPECT_NEAR(std::abs(found.largest().t - found.next().t), 2 * kPi, 1e-6);
}

TEST(TimeExtreme, AJumpIsNoMaximumOfASmoothFunction) {
  for (const double edge : {1.0, 0.975}) {  // between two steps, and within one
    const TimeExtreme up = search([&](double t) { return t < edge ? t : 3 - t; }, even(2, 20));
    EXPECT_TRUE(up.largest().jumps) << edge;
    EXPECT_NEAR(up.largest().t, edge, 1e-2) << edge;
  }
  const TimeExtreme corner = search([](double t) { return -std::abs(t - 1); }, even(2, 20));
  EXPECT_FALSE(corner.largest().jumps);
  EXPECT_NEAR(corner.largest().t, 1, 1e-7);
}

TEST(TimeExtreme, OfAConstantIsTheConstant) {
  const TimeExtreme found = search([](double) { return 2.0; }, even(1, 5));
  EXPECT_EQ(found.largest().value, 2);
  EXPECT_FALSE(found.next().exists());
}

TEST(TimeExtreme, GoesOnFromACheckpoint) {
  TimeExtreme first = search(vibration, even(1.2, 4)), second;
  Archive archive;
  first.save("x", archive);
  second.restore("x", archive);
  second.advance(1.2, 1.5, vibration);
  EXPECT_NEAR(second.largest().t, kPeak, 1e-6);
}

}  // namespace
}  // namespace orthodyn::time_extreme_test
