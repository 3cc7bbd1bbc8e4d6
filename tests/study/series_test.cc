// Metrics of series of functions with known metrics.
#include "lib/study/quantities/series.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace orthodyn::series_test {
namespace {

constexpr double kPi = std::numbers::pi;

template <class F>
Series sample(F&& f, double end, int n, double uneven = 0) {
  Series s;
  for (int k = 0; k <= n; ++k) {
    const double t = end * k / n + uneven * std::sin(7.0 * k) * end / n;
    s.times.push_back(t);
    s.values.push_back(f(t));
  }
  return s;
}

TEST(Series, FindsTheVertexOfAParabolaBetweenUnevenSamples) {
  const auto s = sample([](double t) { return 3 - 2 * (t - 0.537) * (t - 0.537); }, 1, 10, 0.2);
  EXPECT_NEAR(maximum(s), 3, 1e-13);
  EXPECT_NEAR(time_of_maximum(s), 0.537, 1e-13);
}

TEST(Series, ReportsExtremaAtTheEndsAsTheyAre) {
  const auto s = sample([](double t) { return t; }, 2, 5);
  EXPECT_EQ(maximum(s), 2);
  EXPECT_EQ(time_of_maximum(s), 2);
  EXPECT_EQ(maximum(s, -1), 0);
  EXPECT_EQ(time_of_maximum(s, -1), 0);
}

TEST(Series, MeanIsOverTimeAndNotOverSamples) {
  Series s;
  s.times = {0, 1, 1.01, 1.02, 2};
  s.values = {0, 1, 1.01, 1.02, 2};
  EXPECT_NEAR(mean(s), 1, 1e-14);
}

TEST(Series, TheMeanOfAParabolaIsExactOnUnevenSamples) {
  for (const int n : {2, 3, 9}) EXPECT_NEAR(mean(sample([](double t) { return 1 + 3 * t * t; }, 2, n)), 5, 1e-13) << n;
  const auto s = sample([](double t) { return t * t; }, 1, 9, 0.2);
  const double a = s.times.front(), b = s.times.back();
  EXPECT_NEAR(mean(s), (b * b * b - a * a * a) / 3 / (b - a), 1e-14);
}

TEST(Series, FrequencyIsThatOfASineOnAnyLevel) {
  const double f = 3.7;
  const auto s = sample([&](double t) { return 5 + 0.1 * std::sin(2 * kPi * f * t + 0.3); }, 10 / f, 4000);
  EXPECT_NEAR(frequency(s), f, 1e-6 * f);
}

TEST(Series, WhatDoesNotSwingHasNoFrequency) {
  EXPECT_TRUE(std::isnan(frequency(sample([](double t) { return t * t; }, 1, 50))));
  EXPECT_TRUE(std::isnan(frequency(Series{})));
}

TEST(Series, SettlesWhereItsLastExcursionEnds) {
  // exp(-t) cos(10 t) starts at 1 and has its minimum, -0.73, at 0.304: it stays within 5 % of that range from a time
  // between the peaks at 2.19 and 2.50.
  const Series s = sample([](double t) { return std::exp(-t) * std::cos(10 * t); }, 8, 8000);
  const double settled = settling_time(s, 0.05);
  EXPECT_GT(settled, 2.19);
  EXPECT_LT(settled, 2.50);
  EXPECT_NEAR(std::abs(std::exp(-settled) * std::cos(10 * settled)), 0.05 * 1.7304, 1e-3);
  EXPECT_TRUE(std::isnan(settling_time(sample([](double t) { return std::cos(10 * t); }, 8, 800), 0.05)));
  EXPECT_EQ(settling_time(sample([](double) { return 3.0; }, 8, 10), 0.05), 0);
}

TEST(Series, DriftOfAVectorIsTheLongestChange) {
  Series s;
  s.components = 3;
  s.times = {0, 1, 2};
  s.values = {1, 1, 1, 1, 4, 5, 1, 2, 1};
  EXPECT_DOUBLE_EQ(drift(s), 5);
}

TEST(Series, GainCountsRisesAboveTheStartOnly) {
  EXPECT_DOUBLE_EQ(gain({1, {0, 1, 2, 3}, {2, -5, 2.5, 1}}), 0.5);
  EXPECT_DOUBLE_EQ(gain({1, {0, 1, 2}, {2, 1, 0}}), 0);
  EXPECT_TRUE(std::isnan(gain({1, {0, 1}, {2, std::nan("")}})));
  EXPECT_TRUE(std::isnan(gain(Series{})));
}

TEST(Series, OnsetIsWhenTheSizeFirstPassesALevel) {
  const Series s{1, {0, 1, 2, 3}, {0, -0.5, -1.5, 4}};
  EXPECT_DOUBLE_EQ(onset(s, 1), 1.5);
  EXPECT_DOUBLE_EQ(onset(s, 0.25), 0.5);
  EXPECT_DOUBLE_EQ(onset({1, {2, 3}, {5, 6}}, 1), 2);
  EXPECT_TRUE(std::isnan(onset(s, 5)));
}

TEST(Series, TheMaximumAtACornerIsItsSample) {
  Series ramp;  // up to 0.1 at t = 1, then level, sampled unevenly
  for (const double t : {0.0, 0.4, 0.8, 0.9, 1.0, 1.3, 1.7, 2.5}) {
    ramp.times.push_back(t);
    ramp.values.push_back(0.1 * std::min(t, 1.0));
  }
  EXPECT_EQ(maximum(ramp), 0.1);
  EXPECT_EQ(time_of_maximum(ramp), 1);
  Series tent;
  for (const double t : {0.0, 0.5, 1.0, 1.4, 2.0, 3.0}) {
    tent.times.push_back(t);
    tent.values.push_back(t < 1 ? t : 2 - t);
  }
  EXPECT_EQ(maximum(tent), 1);
  EXPECT_EQ(maximum(tent, -1), -1);
}

}  // namespace
}  // namespace orthodyn::series_test
