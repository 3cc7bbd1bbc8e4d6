// Solutions of the equation S X + X S = B are as accurate as the condition of S allows.
#include "lib/element/lyapunov.h"

#include <gtest/gtest.h>

#include "tests/material/constants.h"

namespace orthodyn::lyapunov_test {
namespace {

Mat3 symmetric(const Mat3& A) { return A + A.transpose(); }

Mat3 with_eigenvalues(const Vec3& values, Random& random) {
  const Mat3 V = random.rotation();
  return 0.5 * symmetric(V * values.asDiagonal() * V.transpose());
}

const std::vector<Vec3>& stretches() {
  static const std::vector<Vec3> all{{1, 1, 1},    {1, 1 + 1e-9, 1}, {2, 1, 0.5},
                                     {1, 1e-3, 1}, {1, 1e-8, 1e-8},  {1e6, 1, 1}};
  return all;
}

// The residual is of the order of round-off in S X, for any condition number of S.
TEST(Lyapunov, EquationHolds) {
  Random random(3);
  for (const Vec3& values : stretches())
    for (int i = 0; i < 50; ++i) {
      const Mat3 S = with_eigenvalues(values, random), B = symmetric(random.matrix());
      const Mat3 X = solve_lyapunov<double>(S, B);
      EXPECT_LE((S * X + X * S - B).norm(), 1e-14 * S.norm() * X.norm()) << values.transpose();
      EXPECT_EQ(X, Mat3(X.transpose()));
    }
}

TEST(Lyapunov, SolutionIsThatByEigenvalues) {
  Random random(4);
  for (const Vec3& values : stretches())
    for (int i = 0; i < 50; ++i) {
      const Mat3 S = with_eigenvalues(values, random), expected = symmetric(random.matrix());
      const Mat3 X = solve_lyapunov<double>(S, S * expected + expected * S);
      EXPECT_LE((X - expected).norm(), 1e-14 * values.maxCoeff() / values.minCoeff() * expected.norm());
    }
}

}  // namespace
}  // namespace orthodyn::lyapunov_test
