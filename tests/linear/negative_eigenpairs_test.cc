// Pairs with the most negative eigenvalues, beside a dense solution.
#include "lib/linear/negative_eigenpairs.h"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>

namespace orthodyn::negative_eigenpairs_test {
namespace {

constexpr int kSize = 400;  // unknowns; up to 300 a dense solver is used

struct Pencil {
  Pattern pattern;
  std::vector<double> A, B;
};

// A: a diagonal with a few negative entries. B: 2 on the diagonal, -1/2 beside it.
Pencil pencil() {
  Pencil out;
  out.pattern.n = kSize;
  for (int j = 0; j < kSize; ++j) {
    out.pattern.column_start.push_back(out.pattern.non_zeros());
    out.pattern.row.push_back(j);
    out.A.push_back(j % 50 == 7 ? -1.0 / (1 + j / 50) : 1e-3 * j);
    out.B.push_back(2);
    if (j + 1 == kSize) continue;
    out.pattern.row.push_back(j + 1);
    out.A.push_back(0);
    out.B.push_back(-0.5);
  }
  out.pattern.column_start.push_back(out.pattern.non_zeros());
  return out;
}

Eigen::MatrixXd dense(const Pattern& pattern, const std::vector<double>& values) {
  const Eigen::MatrixXd stored(pattern.matrix(values.data()));
  return stored.selfadjointView<Eigen::Lower>();
}

// Few pairs, more than lie below the bound, and more than the matrix has.
TEST(NegativeEigenPairs, AreTheLowestBelowTheBound) {
  constexpr double kBound = 0.1;
  const Pencil p = pencil();
  const Vector all =
      Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::MatrixXd>(dense(p.pattern, p.A), dense(p.pattern, p.B))
          .eigenvalues();
  const Eigen::Index below = (all.array() < -kBound).count();
  ASSERT_GT(below, 3);
  ASSERT_LT(below, 20);
  for (const int count : {2, 15, 1000}) {
    const NegativeEigenPairs found = negative_eigenpairs(p.pattern, p.A, p.B, kBound, count);
    ASSERT_EQ(found.values.size(), std::min<Eigen::Index>(count, below)) << count;
    ASSERT_EQ(found.shapes.cols(), found.values.size());
    for (Eigen::Index k = 0; k < found.values.size(); ++k) EXPECT_NEAR(found.values[k], all[k], 1e-8) << count;
  }
}

}  // namespace
}  // namespace orthodyn::negative_eigenpairs_test
