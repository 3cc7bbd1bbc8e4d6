// The supernodal Cholesky factorisation: its blocks, precisions and threads.
#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "lib/core/parallel.h"
#include "lib/linear/solver.h"
#include "lib/linear/supernodal_factor.h"
#include "tests/linear/systems.h"

namespace orthodyn {
namespace {

constexpr SolveTolerance kNewton{1e-2, 0};

// Random diagonally dominant matrix without zeros: a single supernode.
System full_system(Random& random, int n) { return random_system(random, n, 1, true); }

// A block for each number of columns, which are coupled to the last unknowns.
System arrow(Random& random, const std::vector<int>& blocks, int last) {
  int n = last;
  for (int b : blocks) n += b;
  Eigen::MatrixXd full = Eigen::MatrixXd::Zero(n, n);
  int first = 0;
  const auto fill = [&](int row, int rows, int column, int columns) {
    full.block(row, column, rows, columns) =
        Eigen::MatrixXd::NullaryExpr(rows, columns, [&] { return random.between(-1, 1); });
  };
  for (int b : blocks) {
    fill(first, b, first, b);
    fill(n - last, last, first, b);
    first += b;
  }
  fill(first, last, first, last);
  full = Eigen::MatrixXd(full.triangularView<Eigen::Lower>());
  full = Eigen::MatrixXd(full + full.transpose());
  for (int i = 0; i < n; ++i) full(i, i) = 1 + full.row(i).cwiseAbs().sum();
  return sparse(full, true);
}

std::vector<System> systems() {
  Random random{5};
  std::vector<System> all{sparse(Eigen::MatrixXd::Constant(1, 1, 2), true),
                          sparse(Eigen::MatrixXd::Identity(7, 7), true),
                          laplacian(3),
                          laplacian(11),
                          points(4),
                          arrow(random, {3, 1, 5, 30}, 4),
                          arrow(random, {90, 70, 33}, 200)};
  for (int n : {2, 3, 5, 6, 7, 13, 48, 49, 97, 300, 450}) all.push_back(full_system(random, n));
  for (int k = 0; k < 5; ++k) all.push_back(random_system(random, 40 + 30 * k, 0.03, true));
  return all;
}

double relative_residual(const System& s, const Vector& x, const Vector& b) {
  return (s.multiply(x) - b).norm() / b.norm();
}

double energy_error(const System& s, const Vector& x, const Vector& exact) {
  return std::sqrt((x - exact).dot(s.multiply(x - exact)) / exact.dot(s.multiply(exact)));
}

TEST(Supernodes, DivideColumnsAndCoverEveryEntryOfTheFactor) {
  for (const System& s : systems()) {
    const Supernodes nodes = find_supernodes(s.pattern);
    const int n = s.pattern.n;
    std::set<int> order(nodes.order.begin(), nodes.order.end());
    EXPECT_EQ(static_cast<int>(order.size()), n);
    ASSERT_EQ(nodes.first_column.front(), 0);
    ASSERT_EQ(nodes.first_column.back(), n);
    const Eigen::PermutationMatrix<Eigen::Dynamic> to(Eigen::Map<const Eigen::VectorXi>(nodes.order.data(), n));
    const Eigen::MatrixXd permuted = to.transpose() * s.dense() * to;
    const Eigen::MatrixXd L = permuted.llt().matrixL();
    for (int k = 0; k < nodes.count(); ++k) {
      const std::vector<int> rows(nodes.rows_of(k), nodes.rows_of(k) + nodes.num_rows(k));
      EXPECT_TRUE(std::is_sorted(rows.begin(), rows.end()));
      ASSERT_GT(nodes.num_columns(k), 0);
      EXPECT_EQ(rows[0], nodes.first_column[static_cast<std::size_t>(k)]);
      for (int j = rows[0]; j < rows[0] + nodes.num_columns(k); ++j)
        for (int i = j; i < n; ++i)
          EXPECT_TRUE(std::abs(L(i, j)) < 1e-12 || std::binary_search(rows.begin(), rows.end(), i)) << i << ", " << j;
    }
  }
}

// The subtrees and the supernodes above them are all supernodes, and no supernode updates another subtree.
TEST(Supernodes, SubtreesAreIndependent) {
  int most = 0;
  for (const System& s : {laplacian(4), laplacian(12), laplacian(20)}) {
    const Supernodes nodes = find_supernodes(s.pattern);
    std::vector<int> subtree_of(static_cast<std::size_t>(nodes.count()), -1);
    std::size_t in_subtrees = 0;
    for (std::size_t t = 0; t < nodes.subtrees.size(); ++t)
      for (int k = nodes.subtrees[t].begin; k < nodes.subtrees[t].end; ++k, ++in_subtrees)
        subtree_of[static_cast<std::size_t>(k)] = static_cast<int>(t);
    EXPECT_EQ(in_subtrees + nodes.top.size(), static_cast<std::size_t>(nodes.count()));
    for (int k : nodes.top) EXPECT_EQ(subtree_of[static_cast<std::size_t>(k)], -1);
    for (int k = 0; k < nodes.count(); ++k) {
      const int own = subtree_of[static_cast<std::size_t>(k)];
      const auto at = static_cast<std::size_t>(k);
      for (int u = nodes.updates_start[at]; own >= 0 && u < nodes.updates_start[at + 1]; ++u)
        EXPECT_EQ(subtree_of[static_cast<std::size_t>(nodes.updates[static_cast<std::size_t>(u)].from)], own);
    }
    most = std::max(most, static_cast<int>(nodes.subtrees.size()));
  }
  EXPECT_GE(most, 8);
}

TEST(SupernodalFactor, SolvesToRoundOffInBothPrecisions) {
  Random random{6};
  for (const System& s : systems()) {
    const Supernodes nodes = find_supernodes(s.pattern);
    SupernodalFactor<double> exact(nodes);
    SupernodalFactor<float> single(nodes);
    ASSERT_TRUE(exact.factor(s.values.data()));
    ASSERT_TRUE(single.factor(s.values.data()));
    const Vector b = random_vector(random, s.pattern.n);
    Vector x(b.size()), y(b.size());
    exact.solve(b, x);
    single.solve(b, y);
    EXPECT_LE(backward_error(s, x, b), 32 * kEps) << s.pattern.n;
    EXPECT_LE(backward_error(s, y, b), 32 * std::numeric_limits<float>::epsilon()) << s.pattern.n;
    EXPECT_TRUE(s.pattern.n < 100 || backward_error(s, y, b) > 32 * kEps) << "not in single precision";
  }
}

TEST(SupernodalFactor, ThreadsChangeNoBit) {
  const System s = laplacian(22);
  const Supernodes nodes = find_supernodes(s.pattern);
  const Vector b = Vector::LinSpaced(s.pattern.n, -1, 2);
  const auto solution = [&](int threads) {
    const LoopThreads loop(threads);
    SupernodalFactor<double> factor(nodes);
    EXPECT_TRUE(factor.factor(s.values.data()));
    Vector x(b.size());
    factor.solve(b, x);
    return x;
  };
  const Vector one = solution(1);
  for (int threads : {2, 3, 8}) EXPECT_EQ(solution(threads), one) << threads;
}

// Powers of two, so that scaling rounds nothing: 1e-216 and 1e216.
TEST(SupernodalFactor, SinglePrecisionTakesMatricesAndRightHandSidesOfAnySize) {
  System s = laplacian(6);
  const Supernodes nodes = find_supernodes(s.pattern);
  const Vector b = Vector::LinSpaced(s.pattern.n, -1, 2);
  Vector expected(b.size()), x(b.size());
  SupernodalFactor<float> factor(nodes);
  ASSERT_TRUE(factor.factor(s.values.data()));
  factor.solve(b, expected);
  for (const double size : {0x1p-717, 0x1p717}) {
    System scaled = s;
    for (double& value : scaled.values) value *= size;
    ASSERT_TRUE(factor.factor(scaled.values.data()));
    factor.solve(size * b, x);
    EXPECT_EQ(x, expected) << size;
    factor.solve(b, x);
    EXPECT_EQ(x * size, expected) << size;
  }
}

TEST(Cholesky, UsesSinglePrecisionOnlyForCorrectionsOfNewtonsMethod) {
  const System s = laplacian(14);
  const Vector exact = Vector::LinSpaced(s.pattern.n, -1, 2), b = s.multiply(exact);
  const auto solver = make_linear_solver("cholesky");
  Vector x(b.size());
  const auto error = [&] {
    EXPECT_EQ(solver->factor(s.values.data()), FactorStatus::ok);
    solver->solve(b, x);  // refined, to see the error
    solver->solve(b, x);
    return energy_error(s, x, exact);
  };
  solver->analyze(s.pattern);
  EXPECT_LE(error(), 1e-13);
  EXPECT_EQ(solver->description().find("single"), std::string::npos);
  const std::size_t bytes = solver->factor_bytes();
  solver->set_tolerance(kNewton);
  const double in_single = error();
  EXPECT_LE(in_single, 1e-5);
  EXPECT_GT(in_single, 1e-10);
  EXPECT_NE(solver->description().find("1 factors in single precision, 1 in double"), std::string::npos)
      << solver->description();
  EXPECT_LT(solver->factor_bytes(), 0.7 * static_cast<double>(bytes));
}

// A full matrix with eigenvalues from 1 / condition to 1.
System ill_conditioned(Random& random, int n, double condition) {
  const Eigen::MatrixXd any = Eigen::MatrixXd::NullaryExpr(n, n, [&] { return random.between(-1, 1); });
  const Eigen::MatrixXd Q = any.householderQr().householderQ();
  const Vector eigenvalues =
      Vector::NullaryExpr(n, [&](Eigen::Index i) { return std::pow(condition, -static_cast<double>(i) / (n - 1)); });
  return sparse(Q * eigenvalues.asDiagonal() * Q.transpose(), true);
}

TEST(Cholesky, AnswersToTheToleranceHoweverIllConditionedTheMatrixIs) {
  int doubles = 0;
  Random random{7};
  for (const double condition : {1e2, 1e4, 1e5, 1e6, 1e7, 1e8, 1e9, 1e10}) {
    const System s = ill_conditioned(random, 40, condition);
    const Vector exact = Vector::LinSpaced(40, 0, 1), b = s.multiply(exact);
    const auto solver = make_linear_solver("cholesky");
    solver->analyze(s.pattern);
    solver->set_tolerance(kNewton);
    for (int k = 0; k < 3; ++k) {
      ASSERT_EQ(solver->factor(s.values.data()), FactorStatus::ok);
      Vector x = b;
      solver->solve(x, x);
      EXPECT_LE(energy_error(s, x, exact), 1e-3) << condition;
      solver->solve(b, x);
      EXPECT_LE(energy_error(s, x, exact), 1e-3) << condition;
    }
    if (solver->description().find("double") != std::string::npos) ++doubles;
  }
  EXPECT_GT(doubles, 0);
  EXPECT_LT(doubles, 8);
}

TEST(Cholesky, ZeroAndNaNAreSolvedAsSuch) {
  const System s = laplacian(4);
  const auto solver = make_linear_solver("cholesky");
  solver->analyze(s.pattern);
  solver->set_tolerance(kNewton);
  ASSERT_EQ(solver->factor(s.values.data()), FactorStatus::ok);
  Vector x(s.pattern.n);
  solver->solve(Vector::Zero(s.pattern.n), x);
  EXPECT_TRUE(x.isZero(0));
  solver->solve(Vector::Constant(s.pattern.n, std::nan("")), x);
  EXPECT_TRUE(x.hasNaN());
}

TEST(Cholesky, FindsIndefiniteMatricesInSinglePrecisionToo) {
  System s = laplacian(6);
  const System good = s;
  diagonal(s, 100) = -0.5;
  const auto solver = make_linear_solver("cholesky");
  solver->analyze(s.pattern);
  solver->set_tolerance(kNewton);
  EXPECT_EQ(solver->factor(s.values.data()), FactorStatus::not_positive_definite);
  ASSERT_EQ(solver->factor(good.values.data()), FactorStatus::ok);
  const Vector b = Vector::LinSpaced(s.pattern.n, -1, 2);
  Vector x(b.size());
  solver->solve(b, x);
  EXPECT_LE(relative_residual(good, x, b), 1e-3);
}

}  // namespace
}  // namespace orthodyn
