// The analytic continuation of the polar decomposition, on which all complex-step tests are based.
#include <gtest/gtest.h>

#include "lib/element/polar.h"
#include "tests/element/states.h"

namespace orthodyn::polar_complex_test {
namespace {

Mat3 rotation_of(const Mat3& F) { return polar(F, Mat3::Identity()).R; }

Mat3 rotation_rate(const Mat3& F, const Mat3& dF) {
  return derivative([](const CMat3& G) { return polar(G, Mat3::Identity()).R; }, F, dF);
}

const Vec3 kStretches[] = {{1.6, 1, 0.6}, {1.2, 0.7, 0}, {1.2, 0.7, -0.4}};

TEST(ComplexPolar, AtARealStateIsTheRealOne) {
  Random random(12);
  for (const Vec3& s : kStretches) {
    const Mat3 F = random_state(random, s).F();
    const auto p = polar(CMat3(F.cast<Complex>()), Mat3::Identity());
    const auto real = polar(F, Mat3::Identity());
    EXPECT_LE((p.R - real.R.cast<Complex>()).norm(), 32 * kEps);
    EXPECT_LE((p.S - real.S.cast<Complex>()).norm(), 32 * kEps);
  }
}

TEST(ComplexPolar, CentralDifferencesOfTheRealOneApproachItsDerivativeWithOrderTwo) {
  Random random(13);
  for (const Vec3& s : kStretches) {
    const Mat3 F = random_state(random, s).F(), dF = random.matrix().normalized();
    const Mat3 exact = rotation_rate(F, dF);
    const auto error = [&](double h) {
      return ((rotation_of(F + h * dF) - rotation_of(F - h * dF)) / (2 * h) - exact).norm();
    };
    const double order = std::log2(error(4e-3) / error(2e-3));
    EXPECT_GT(order, 1.9);
    EXPECT_LT(order, 2.1);
  }
}

TEST(ComplexPolar, SatisfiesItsEquationsAwayFromTheRealAxis) {
  Random random(14);
  const CMat3 F =
      random_state(random, {1.6, 1, 0.6}).F().cast<Complex>() + Complex(0, 0.02) * random.matrix().cast<Complex>();
  const auto p = polar(F, Mat3::Identity());
  EXPECT_LE((p.R.transpose() * p.R - CMat3::Identity()).norm(), 64 * kEps);
  EXPECT_LE((p.R * p.S - F).norm(), 64 * kEps);
}

TEST(ComplexPolar, TheRateOfRIsTheOneOfTheRotationVector) {
  Random random(15);
  for (const Vec3& s : kStretches) {
    const Mat3 F = random_state(random, s).F(), dF = random.matrix();
    const auto p = polar(F, Mat3::Identity());
    const Vec3 w = p.G_inverse * axial<double>(p.R.transpose() * dF);
    const double condition = s.norm() / (s[1] + s[2]);
    EXPECT_LE((rotation_rate(F, dF) - p.R * cross_matrix<double>(w)).norm(), 64 * kEps * condition * w.norm());
  }
}

}  // namespace
}  // namespace orthodyn::polar_complex_test
