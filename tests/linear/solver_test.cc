// Properties that every direct solver in the registry must have.
#include "lib/linear/solver.h"

#include <gtest/gtest.h>

#include <numbers>

#include "tests/linear/systems.h"

namespace orthodyn::solver_test {
namespace {

// Gaussian elimination without pivot growth has a backward error of a few eps for any n.
constexpr double kRoundOff = 32 * kEps;

std::vector<std::string> solvers(const std::function<bool(const SolverKind&)>& wanted) {
  std::vector<std::string> names;
  for (const auto& [name, kind] : solver_registry())
    if (kind.make && name != "petsc" && wanted(kind)) names.push_back(name);
  return names;
}

class AnySolver : public testing::TestWithParam<std::string> {
 protected:
  std::unique_ptr<LinearSolver> make() const { return make_linear_solver(GetParam()); }

  std::unique_ptr<LinearSolver> factored(const System& s) const {
    auto solver = make();
    solver->analyze(s.pattern);
    EXPECT_EQ(solver->factor(s.values.data()), FactorStatus::ok);
    return solver;
  }

  Random random_{71};
};
INSTANTIATE_TEST_SUITE_P(Registry, AnySolver, testing::ValuesIn(solvers([](const SolverKind&) { return true; })),
                         [](const auto& tested) { return tested.param; });

Vector solution(LinearSolver& solver, const Vector& b) {
  Vector x(b.size());
  solver.solve(b, x);
  return x;
}

TEST_P(AnySolver, SolvesRandomPositiveDefiniteSystemsToRoundOff) {
  for (const int n : {1, 2, 7, 60, 300}) {
    const System s = random_system(random_, n, 5.0 / n, true);
    const Vector b = random_vector(random_, n);
    EXPECT_LE(backward_error(s, solution(*factored(s), b), b), kRoundOff) << n;
  }
}

TEST_P(AnySolver, FindsTheSolutionThatDenseEliminationFinds) {
  const System s = random_system(random_, 40, 0.2, true);
  const Vector b = random_vector(random_, 40), expected = s.dense().llt().solve(b);
  // By Gershgorin's theorem the condition number is below 21 times the ratio of the largest to the smallest diagonal
  // entry.
  EXPECT_LE((solution(*factored(s), b) - expected).norm(), 1e-12 * expected.norm());
}

TEST_P(AnySolver, SolvesALargeSystemToRoundOff) {
  const System s = laplacian(18);
  const Vector b = random_vector(random_, s.pattern.n);
  EXPECT_LE(backward_error(s, solution(*factored(s), b), b), kRoundOff);
}

TEST_P(AnySolver, TakesNewValuesOnTheSamePattern) {
  System s = random_system(random_, 50, 0.1, true);
  const auto solver = factored(s);
  for (double factor : {3.0, 1e8, 1e-8}) {
    for (double& value : s.values) value *= factor;
    for (int i = 0; i < s.pattern.n; ++i) diagonal(s, i) *= random_.between(1, 2);
    ASSERT_EQ(solver->factor(s.values.data()), FactorStatus::ok);
    const Vector b = random_vector(random_, s.pattern.n);
    EXPECT_LE(backward_error(s, solution(*solver, b), b), kRoundOff) << factor;
  }
}

TEST_P(AnySolver, TakesAnotherPattern) {
  const System first = random_system(random_, 30, 0.2, true), second = random_system(random_, 45, 0.1, true);
  const auto solver = factored(first);
  solver->analyze(second.pattern);
  ASSERT_EQ(solver->factor(second.values.data()), FactorStatus::ok);
  const Vector b = random_vector(random_, 45);
  EXPECT_LE(backward_error(second, solution(*solver, b), b), kRoundOff);
}

TEST_P(AnySolver, SolvesInPlace) {
  const System s = random_system(random_, 50, 0.1, true);
  const auto solver = factored(s);
  const Vector b = random_vector(random_, 50);
  Vector x = b;
  solver->solve(x, x);
  EXPECT_EQ(x, solution(*solver, b));
}

TEST_P(AnySolver, SolvesForASegmentOfALongerVector) {
  const System s = random_system(random_, 20, 0.2, true);
  const auto solver = factored(s);
  Vector both = random_vector(random_, 40);
  const Vector b = both.tail(20);
  solver->solve(both.tail(20), both.head(20));
  EXPECT_EQ(Vector(both.head(20)), solution(*solver, b));
  EXPECT_EQ(Vector(both.tail(20)), b);
}

TEST_P(AnySolver, KnowsTheBytesOfItsFactorAfterAnalysisAndAfterFactoring) {
  const System s = laplacian(6);
  const auto solver = make();
  EXPECT_EQ(solver->factor_bytes(), 0u);
  solver->analyze(s.pattern);
  const std::size_t predicted = solver->factor_bytes();
  ASSERT_EQ(solver->factor(s.values.data()), FactorStatus::ok);
  const std::size_t least = s.values.size() * sizeof(double);  // L has at least the entries of the lower triangle
  EXPECT_GE(solver->factor_bytes(), least);
  EXPECT_GE(predicted, least);
  EXPECT_NEAR(static_cast<double>(predicted), static_cast<double>(solver->factor_bytes()),
              0.2 * static_cast<double>(predicted));
}

TEST_P(AnySolver, SaysWhatItChose) {
  const System s = laplacian(3);
  EXPECT_FALSE(factored(s)->description().empty());
}

// `auto` chooses a solver for definite matrices if the pattern is symmetric, else one for general matrices.
class CholeskySolver : public AnySolver {};
INSTANTIATE_TEST_SUITE_P(Registry, CholeskySolver, testing::Values("auto", "cholesky", "cholmod", "eigen_ldlt"),
                         [](const auto& tested) { return tested.param; });

// A symmetric matrix with a negative diagonal entry has a negative eigenvalue, and by Sylvester's law a negative pivot.
// All other pivots are positive, so the solver must detect a single negative pivot at any position.
TEST_P(CholeskySolver, FindsANegativePivotAnywhereInASmallMatrix) {
  for (const int at : {0, 30, 63}) {
    System s = laplacian(4);
    diagonal(s, at) = -0.5;
    const auto solver = make();
    solver->analyze(s.pattern);
    EXPECT_EQ(solver->factor(s.values.data()), FactorStatus::not_positive_definite) << at;
  }
}

TEST_P(CholeskySolver, FindsANegativePivotAnywhereInALargeMatrix) {
  for (const int at : {0, 4000, 8000 - 1}) {
    System s = laplacian(20);
    diagonal(s, at) = -0.5;
    const auto solver = make();
    solver->analyze(s.pattern);
    EXPECT_EQ(solver->factor(s.values.data()), FactorStatus::not_positive_definite) << at;
  }
}

// The smallest eigenvalue of the Laplacian on m^3 points is 12 sin^2(pi / (2 (m + 1))).
TEST_P(CholeskySolver, TellsASlightlyIndefiniteMatrixFromAPositiveOne) {
  for (const int m : {4, 16}) {
    const double smallest = 12 * std::pow(std::sin(std::numbers::pi / (2 * (m + 1))), 2);
    for (const bool definite : {true, false}) {
      System s = laplacian(m);
      for (int i = 0; i < s.pattern.n; ++i) diagonal(s, i) -= (definite ? 1 - 1e-6 : 1 + 1e-6) * smallest;
      const auto solver = make();
      solver->analyze(s.pattern);
      EXPECT_EQ(solver->factor(s.values.data()), definite ? FactorStatus::ok : FactorStatus::not_positive_definite);
    }
  }
}

TEST_P(CholeskySolver, IsNotSpoiledByARefusedMatrix) {
  for (const int m : {4, 18}) {
    System s = laplacian(m);
    const System good = s;
    diagonal(s, 5) = -1;
    const auto solver = factored(good);
    ASSERT_EQ(solver->factor(s.values.data()), FactorStatus::not_positive_definite);
    ASSERT_EQ(solver->factor(good.values.data()), FactorStatus::ok);
    const Vector b = random_vector(random_, good.pattern.n);
    EXPECT_LE(backward_error(good, solution(*solver, b), b), kRoundOff);
  }
}

TEST_P(CholeskySolver, DoesNotCallAMatrixOfNaNsPositive) {
  System s = laplacian(4);
  diagonal(s, 10) = std::nan("");
  const auto solver = make();
  solver->analyze(s.pattern);
  EXPECT_NE(solver->factor(s.values.data()), FactorStatus::ok);
}

class UnsymmetricSolver : public AnySolver {};
INSTANTIATE_TEST_SUITE_P(Registry, UnsymmetricSolver,
                         testing::ValuesIn(solvers([](const SolverKind& kind) { return kind.takes_general; })),
                         [](const auto& tested) { return tested.param; });

TEST_P(UnsymmetricSolver, TellsTheSignOfTheDeterminant) {
  int negative = 0;
  for (int k = 0; k < 20; ++k) {
    Eigen::MatrixXd full = Eigen::MatrixXd::NullaryExpr(9, 9, [this] { return random_.between(-1, 1); });
    for (int i = 0; i < 9; ++i) full((i + 2) % 9, i) = full((i + 5) % 9, i) = 0;
    const double determinant = full.determinant();
    EXPECT_EQ(factored(sparse(full, false))->has_negative_determinant(), determinant < 0);
    if (determinant < 0) ++negative;
  }
  EXPECT_GT(negative, 0);
  EXPECT_LT(negative, 20);
}

class GeneralSolver : public AnySolver {};
INSTANTIATE_TEST_SUITE_P(Registry, GeneralSolver, testing::Values("klu"),
                         [](const auto& tested) { return tested.param; });

TEST_P(UnsymmetricSolver, SolvesRandomGeneralSystemsToRoundOff) {
  for (const int n : {1, 2, 7, 60, 300}) {
    const System s = random_system(random_, n, 5.0 / n, false);
    const Vector b = random_vector(random_, n);
    EXPECT_LE(backward_error(s, solution(*factored(s), b), b), kRoundOff) << n;
  }
}

TEST_P(GeneralSolver, SolvesSymmetricIndefiniteSystems) {
  System s = random_system(random_, 60, 0.1, true);
  for (int i = 0; i < 60; i += 2) diagonal(s, i) *= -1;
  const Vector b = random_vector(random_, 60);
  EXPECT_LE(backward_error(s, solution(*factored(s), b), b), kRoundOff);
}

TEST_P(GeneralSolver, RefusesASingularMatrix) {
  System s = random_system(random_, 10, 0.3, true);
  std::fill(s.values.begin(), s.values.end(), 0);
  const auto solver = make();
  solver->analyze(s.pattern);
  EXPECT_EQ(solver->factor(s.values.data()), FactorStatus::singular);
}

// New values may need other pivots than the first factorisation. With the old pivots entries would grow by a factor of
// 1e6, and six digits would be lost.
TEST_P(GeneralSolver, ChoosesNewPivotsWhereTheOldOnesBecameSmall) {
  Eigen::MatrixXd full(2, 2);
  full << 2, 1, 1, 3;
  System s = sparse(full, false);
  const auto solver = factored(s);
  full << 1e-6, 1, 1, 1e-6;
  s.values = sparse(full, false).values;
  ASSERT_EQ(solver->factor(s.values.data()), FactorStatus::ok);
  const Vector b = Vector::LinSpaced(2, 1, 2);
  EXPECT_LE(backward_error(s, solution(*solver, b), b), kRoundOff);
}

TEST(Solvers, CholmodIsSimplicialForSmallAndSupernodalForLargeSystems) {
  const auto description = [](int m) {
    const System s = laplacian(m);
    const auto solver = make_linear_solver("cholmod");
    solver->analyze(s.pattern);
    return solver->description();
  };
  EXPECT_EQ(description(4), "simplicial, minimum degree");
#ifdef ORTHODYN_GPL
  EXPECT_EQ(description(18), "supernodal, minimum degree");
#else
  EXPECT_EQ(description(18), "simplicial, minimum degree");
#endif
}

}  // namespace
}  // namespace orthodyn::solver_test
