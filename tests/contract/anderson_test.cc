// Anderson acceleration of linear iterations.
#include "integrators/native/anderson.h"

#include <gtest/gtest.h>

namespace orthodyn::anderson_test {
namespace {

// Norm of x after the given number of iterations x <- x + g(x), g(x) = -A x, from a vector of ones.
double left_after(int iterations, const Eigen::MatrixXd& A) {
  Anderson anderson(A.rows(), static_cast<int>(A.rows()));
  Vector x = Vector::Ones(A.rows());
  for (int k = 0; k < iterations; ++k) {
    Vector g = -A * x;
    anderson.accelerate(x, g);
    x += g;
  }
  return x.norm();
}

// A combination of n + 1 corrections in n dimensions is zero.
TEST(Anderson, SolvesALinearSystemInAsManyIterationsAsItHasUnknowns) {
  const Eigen::Matrix4d A{{0.5, 0.1, 0, 0.2}, {-0.1, 0.9, 0.1, 0}, {0.3, 0, 0.3, 0}, {0, 0.2, 0, 1.6}};
  EXPECT_LE(left_after(6, A), 1e-12);
}

TEST(Anderson, MakesADivergentIterationConverge) {
  const Eigen::Matrix2d A{{2.5, 0}, {0, 0.5}};  // x - A x grows by 1.5 in its first part
  EXPECT_LE(left_after(4, A), 1e-12);
}

TEST(Anderson, BeginsAnewAfterARestart) {
  Anderson anderson(2, 2);
  Vector g{{1, 2}};
  anderson.accelerate(Vector::Zero(2), g);
  anderson.restart();
  Vector other{{3, 4}};
  anderson.accelerate(Vector::Ones(2), other);
  EXPECT_EQ(other, (Vector{{3, 4}}));
}

}  // namespace
}  // namespace orthodyn::anderson_test
