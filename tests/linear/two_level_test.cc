// Conjugate gradients with a coarse space, for a chain of springs. The coarse space has every other node.
#include "lib/linear/two_level.h"

#include <gtest/gtest.h>

namespace orthodyn::two_level_test {
namespace {

struct String {
  Pattern pattern;
  std::vector<double> values;
};

// A tridiagonal matrix: 2 + more on the diagonal, -1 beside it.
String string_of(int n, double more = 0) {
  String out;
  out.pattern.n = n;
  for (int j = 0; j < n; ++j) {
    out.pattern.column_start.push_back(out.pattern.non_zeros());
    out.pattern.row.push_back(j), out.values.push_back(2 + more);
    if (j + 1 < n) out.pattern.row.push_back(j + 1), out.values.push_back(-1);
  }
  out.pattern.column_start.push_back(out.pattern.non_zeros());
  return out;
}

Eigen::MatrixXd dense(const String& s) {
  const Eigen::MatrixXd stored(s.pattern.matrix(s.values.data()));
  return stored.selfadjointView<Eigen::Lower>();
}

// Interpolation from the coarse nodes 1, 3, 5 ..., linear between them.
Eigen::MatrixXd lift(int n) {
  Eigen::MatrixXd P = Eigen::MatrixXd::Zero(n, n / 2);
  for (int j = 0; j < n / 2; ++j)
    for (int i = -1; i <= 1; ++i)
      if (2 * j + 1 + i < n) P(2 * j + 1 + i, j) = i == 0 ? 1 : 0.5;
  return P;
}

TEST(TwoLevelSolver, SolvesAndTellsTheEnergyFromBelow) {
  constexpr int n = 41;
  const String s = string_of(n);
  const Eigen::MatrixXd A = dense(s), P = lift(n), coarse = P.transpose() * A * P;
  const TwoLevelSolver solver(
      s.pattern, s.values, [&](const ConstVectorRef& b) { return Vector(P * coarse.ldlt().solve(P.transpose() * b)); });
  const Vector b = Vector::LinSpaced(n, 1, 3), x = A.ldlt().solve(b);
  const auto found = solver.solve(b, 1e-12, 200).front();
  EXPECT_TRUE(found.converged);
  EXPECT_LT((found.x - x).norm(), 1e-5 * x.norm());
  EXPECT_NEAR(found.energy, b.dot(x), 1e-9 * b.dot(x));
  double last = 0;
  for (int most = 1; most < 5; ++most) {
    const auto early = solver.solve(b, 1e-12, most).front();
    EXPECT_GE(early.energy, last);
    EXPECT_LE(early.energy, b.dot(x) * (1 + 1e-12));
    EXPECT_NEAR(early.energy, early.x.dot(A * early.x), 1e-9 * early.energy);
    last = early.energy;
  }
}

// Groups of four, a smaller group and a single column give what each right-hand side gives alone.
TEST(TwoLevelSolver, SolvesForSeveralRightHandSides) {
  constexpr int n = 41;
  const String s = string_of(n);
  const Eigen::MatrixXd P = lift(n), coarse = P.transpose() * dense(s) * P;
  const TwoLevelSolver solver(
      s.pattern, s.values, [&](const ConstVectorRef& b) { return Vector(P * coarse.ldlt().solve(P.transpose() * b)); });
  for (const int count : {4, 6, 9}) {
    Eigen::MatrixXd b(n, count);
    for (int c = 0; c < count; ++c) b.col(c) = Vector::LinSpaced(n, 0, 1).array().pow(c);
    b.col(1).setZero();
    const auto all = solver.solve(b, 1e-6, 200);
    ASSERT_EQ(all.size(), static_cast<std::size_t>(count));
    for (int c = 0; c < count; ++c) {
      const auto& one = all[static_cast<std::size_t>(c)];
      const auto alone = solver.solve(b.col(c), 1e-6, 200).front();
      EXPECT_EQ(one.iterations, alone.iterations) << c;
      EXPECT_EQ(one.converged, alone.converged) << c;
      EXPECT_NEAR(one.energy, alone.energy, 1e-12 * alone.energy) << c;
      EXPECT_LE((one.x - alone.x).norm(), 1e-12 * alone.x.norm()) << c;
    }
  }
}

TEST(TwoLevelSolver, RefusesAMatrixThatIsNotPositiveDefinite) {
  constexpr int n = 21;
  const String s = string_of(n, -0.5);
  const Vector b = Vector::Ones(n);
  EXPECT_THROW(
      TwoLevelSolver(s.pattern, s.values, [](const ConstVectorRef& r) { return Vector(0 * r); }).solve(b, 1e-12, 200),
      IndefiniteMatrix);
}

TEST(TwoLevelSolver, HasNothingToDoForNoLoad) {
  const String s = string_of(5);
  const TwoLevelSolver solver(s.pattern, s.values, [](const ConstVectorRef& r) { return Vector(0 * r); });
  const auto found = solver.solve(Vector::Zero(5), 1e-6, 10).front();
  EXPECT_EQ(found.energy, 0);
  EXPECT_EQ(found.x, Vector::Zero(5));
}

}  // namespace
}  // namespace orthodyn::two_level_test
