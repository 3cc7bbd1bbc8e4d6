// Time derivatives of formulas by finite differences.
#include "lib/fem/differences.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>

namespace orthodyn::differences_test {
namespace {

TEST(Differences, AreExactForPolynomialsOfDegreeEightWhereverTheyAreTaken) {
  for (const double x : {0.0, 0.3, 4.0, 7.5, 8.0}) {
    const DifferenceWeights w(x);
    for (int degree = 0; degree <= 8; ++degree) {
      double first = 0, second = 0, scale = 0;
      for (std::size_t k = 0; k < DifferenceWeights::kPoints; ++k) {
        const double p = std::pow((static_cast<double>(k) - 4) / 4, degree);
        first += w.first[k] * p;
        second += w.second[k] * p;
        scale += std::abs(w.second[k] * p) + std::abs(w.first[k] * p);
      }
      const double s = (x - 4) / 4;
      EXPECT_NEAR(first, degree == 0 ? 0 : degree * std::pow(s, degree - 1) / 4, 1e-14 * scale) << x << " " << degree;
      EXPECT_NEAR(second, degree < 2 ? 0 : degree * (degree - 1) * std::pow(s, degree - 2) / 16, 1e-14 * scale)
          << x << " " << degree;
    }
  }
}

TEST(Differences, OfASineHaveTheErrorThatIsStated) {
  for (const double steps : {60.0, 1000.0}) {  // to a period of 1
    const double w = 2 * std::numbers::pi, t = 0.37;
    const auto d = smooth_differences<double>([&](double s) { return std::sin(w * s); }, t, 1 / steps, {});
    EXPECT_NEAR(d.first, w * std::cos(w * t), 1e-10 * w) << steps;
    EXPECT_NEAR(d.second, -w * w * std::sin(w * t), 1e-10 * w * w) << steps;
  }
}

TEST(Differences, DoNotReachAcrossAKinkAndTakeItsRightSide) {
  const std::vector<double> kinks{1.01, 1};
  const auto f = [](double t) { return t < 1 ? t * t : t < 1.01 ? 1 - 3 * (t - 1) : 0.97 + 5 * (t - 1.01); };
  for (const auto& [t, first, second] : {std::array{0.5, 1.0, 2.0},
                                         {0.999, 1.998, 2.0},
                                         {1.0, -3.0, 0.0},
                                         {1.004, -3.0, 0.0},
                                         {1.01, 5.0, 0.0},
                                         {1.02, 5.0, 0.0}}) {
    const SmoothStretch at(t, 0.01, kinks);
    for (const double kink : kinks)
      EXPECT_FALSE(at.point(0) < kink - 1e-12 && at.point(8) > kink + 1e-12) << t << " " << kink;
    const auto d = smooth_differences<double>(f, t, 0.01, kinks);
    EXPECT_NEAR(d.first, first, 1e-9) << t;
    EXPECT_NEAR(d.second, second, 1e-6) << t;
  }
}

}  // namespace
}  // namespace orthodyn::differences_test
