// The lowest modes of chains with known spectra. Small chains use the dense solver, large ones the iterative solver.
#include "lib/linear/eigenmodes.h"

#include <gtest/gtest.h>

#include <numbers>

#include "lib/core/errors.h"
#include "lib/core/symmetric_eigen.h"
#include "lib/linear/solver.h"
#include "tests/linear/systems.h"

namespace orthodyn::eigenmodes_test {
namespace {

struct Chain {
  System stiffness;
  std::vector<double> mass;
};

// n equal masses joined by unit springs. If `tied`, springs also join both ends to walls.
Chain chain(int n, bool tied, double mass = 1) {
  Chain c;
  auto& pattern = c.stiffness.pattern;
  pattern.n = n;
  pattern.column_start.push_back(0);
  for (int j = 0; j < n; ++j) {
    const bool end = j == 0 || j + 1 == n;
    pattern.row.push_back(j);
    c.stiffness.values.push_back(tied || !end ? 2 : 1);
    c.mass.push_back(mass);
    if (j + 1 < n) {
      pattern.row.push_back(j + 1);
      c.stiffness.values.push_back(-1);
      c.mass.push_back(0);
    }
    pattern.column_start.push_back(pattern.non_zeros());
  }
  return c;
}

EigenPairs lowest(const Chain& c, int count) {
  return lowest_eigenpairs(c.stiffness.pattern, c.stiffness.values, c.mass, count);
}

double four_sine_squared(double angle) { return 4 * std::pow(std::sin(angle), 2); }

TEST(Eigenmodes, OfATiedChainAreItsKnownSpectrum) {
  for (const int n : {20, 400}) {
    const EigenPairs pairs = lowest(chain(n, true, 2), 8);
    EXPECT_EQ(pairs.zeros, 0);
    for (int k = 1; k <= 8; ++k) {
      const double exact = four_sine_squared(k * std::numbers::pi / (2 * (n + 1))) / 2;
      EXPECT_NEAR(pairs.values[k - 1], exact, 1e-10 * exact) << n;
    }
  }
}

TEST(Eigenmodes, OfAFreeChainBeginWithAnExactZero) {
  for (const int n : {20, 400}) {
    const EigenPairs pairs = lowest(chain(n, false), 8);
    EXPECT_EQ(pairs.zeros, 1);
    EXPECT_EQ(pairs.values[0], 0);
    for (int k = 1; k < 8; ++k) {
      const double exact = four_sine_squared(k * std::numbers::pi / (2 * n));
      EXPECT_NEAR(pairs.values[k], exact, 1e-10 * exact) << n;
    }
  }
}

TEST(Eigenmodes, AreMassOrthonormal) {
  for (const int n : {20, 400}) {
    const Chain c = chain(n, false, 3);
    const EigenPairs pairs = lowest(c, 6);
    const Eigen::MatrixXd gram = 3 * pairs.shapes.transpose() * pairs.shapes;
    EXPECT_LT((gram - Eigen::MatrixXd::Identity(6, 6)).cwiseAbs().maxCoeff(), 1e-10) << n;
  }
}

TEST(Eigenmodes, OfAnIndefiniteMatrixBeginWithTheNegativeOnes) {
  Chain c = chain(400, true);
  c.stiffness.values[0] = -1;  // makes the matrix indefinite
  const EigenPairs pairs = lowest(c, 3);
  const Vector all = symmetric_eigenvalues(c.stiffness.dense());
  EXPECT_LT(pairs.values[0], -0.5);
  for (int k = 0; k < 3; ++k) EXPECT_NEAR(pairs.values[k], all[k], 1e-9);
}

// A Laplacian for each of the three coordinates of 343 points.
TEST(Eigenmodes, ByIterationsAreThoseByAFactor) {
  if (!solver_registry().at("petsc").unavailable.empty()) GTEST_SKIP() << "built without PETSc";
  const System s = points(7);
  std::vector<double> mass(s.values.size(), 0);
  for (const int diagonal : s.pattern.column_start)
    if (static_cast<std::size_t>(diagonal) < mass.size()) mass[static_cast<std::size_t>(diagonal)] = 2;
  const EigenPairs direct = lowest_eigenpairs(s.pattern, s.values, mass, 5);
  const EigenPairs iterated = lowest_eigenpairs(
      s.pattern, s.values, mass, 5, [&] { return translations(s.pattern); }, ShiftedSolver::iterative);
  EXPECT_NE(iterated.solver.find("algebraic multigrid"), std::string::npos) << iterated.solver;
  EXPECT_EQ(direct.solver.find("algebraic multigrid"), std::string::npos) << direct.solver;
  for (int k = 0; k < 5; ++k) EXPECT_NEAR(iterated.values[k], direct.values[k], 1e-9 * direct.values[4]);
}

TEST(Eigenmodes, RefuseMoreModesThanUnknowns) {
  try {
    lowest(chain(4, true), 5);
    ADD_FAILURE() << "accepted";
  } catch (const ConfigError& e) {
    EXPECT_STREQ(e.what(), "5 modes were requested, but there are 4 unknowns and as many modes");
  }
  EXPECT_EQ(lowest(chain(4, true), 4).values.size(), 4);
}

}  // namespace
}  // namespace orthodyn::eigenmodes_test
