// Plane waves in spruce. With density rho, speed c and direction n, rho c^2 is an eigenvalue of
// Gamma_ik = C_ijkl n_j n_l.
#include <gtest/gtest.h>

#include "lib/core/symmetric_eigen.h"
#include "lib/material/stiffness.h"
#include "tests/material/constants.h"

namespace orthodyn::waves_test {
namespace {

constexpr double kDensity = 400;  // kg/m^3

Mat6 spruce_in_pascal() { return 1e9 * voigt(stiffness(spruce())); }

// The three wave speeds (m/s) in ascending order.
Vec3 speeds(const Mat6& C, const Vec3& direction) {
  const Vec3 n = direction.normalized();
  Mat3 gamma = Mat3::Zero();
  for (int i = 0; i < 3; ++i)
    for (int k = 0; k < 3; ++k)
      for (int j = 0; j < 3; ++j)
        for (int l = 0; l < 3; ++l) gamma(i, k) += component(C, i, j, k, l) * n[j] * n[l];
  return (symmetric_eigenvalues(gamma) / kDensity).cwiseSqrt();
}

void expect_speeds(const Vec3& found, const Vec3& expected, double tolerance) {
  EXPECT_LE((found - expected).cwiseAbs().maxCoeff(), tolerance) << found.transpose();
}

TEST(Waves, AlongTheMaterialAxesHaveTheirClosedFormSpeeds) {
  const Mat6 C = spruce_in_pascal();
  expect_speeds(speeds(C, Vec3::UnitX()), {1284.523258, 1313.392554, 5302.980823}, 1e-6);
  expect_speeds(speeds(C, Vec3::UnitY()), {282.842712, 1313.392554, 1554.845511}, 1e-6);
  expect_speeds(speeds(C, Vec3::UnitZ()), {282.842712, 1148.757446, 1284.523258}, 1e-6);
}

TEST(Waves, BetweenTheMaterialAxesHaveTheirClosedFormSpeeds) {
  const Mat6 C = spruce_in_pascal();
  expect_speeds(speeds(C, {1, 1, 0}), {930.053762, 1373.120527, 3887.044521}, 1e-6);
  expect_speeds(speeds(C, {1, 1, 1}), {943.88497, 1154.93299, 3270.801466}, 5e-6);
}

TEST(Waves, HaveTheSameSpeedsInARotatedFrame) {
  const Mat6 C = spruce_in_pascal();
  const Mat3 Q = Random(18).rotation();
  const Mat6 K = stress_rotation(Q);
  const Vec3 n(1, 1, 1);
  const Vec3 expected = speeds(C, n);
  expect_speeds(speeds(K * C * K.transpose(), Q * n), expected, 1e3 * kEps * expected[2]);
}

}  // namespace
}  // namespace orthodyn::waves_test
