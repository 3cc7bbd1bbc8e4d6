// The PETSc solver: it meets its tolerance with every preconditioner, and reports failures.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "lib/linear/solver.h"
#include "tests/linear/systems.h"

namespace orthodyn::petsc_test {
namespace {

class Petsc : public testing::Test {
 protected:
  void SetUp() override {
    if (!solver_registry().at("petsc").unavailable.empty()) GTEST_SKIP() << solver_registry().at("petsc").unavailable;
  }

  static std::unique_ptr<LinearSolver> factored(const System& s, const std::string& options = "") {
    auto solver = make_linear_solver({"petsc", options});
    solver->analyze(s.pattern);
    EXPECT_EQ(solver->factor(s.values.data()), FactorStatus::ok);
    return solver;
  }

  Random random_{93};
};

// A pattern in which each point has about `count` random neighbours, at any distance.
System far_neighbours(Random& random, int n, int count) {
  std::vector<std::vector<int>> rows(static_cast<std::size_t>(n));
  for (int j = 0; j < n; ++j)
    for (int c = 0; c < count / 2; ++c) {
      const int i = static_cast<int>(random.between(0, n - 1));
      if (i != j) rows[static_cast<std::size_t>(std::min(i, j))].push_back(std::max(i, j));
    }
  System s;
  s.pattern.n = n;
  s.pattern.column_start.push_back(0);
  for (int j = 0; j < n; ++j) {
    auto& below = rows[static_cast<std::size_t>(j)];
    below.push_back(j);
    std::sort(below.begin(), below.end());
    below.erase(std::unique(below.begin(), below.end()), below.end());
    s.pattern.row.insert(s.pattern.row.end(), below.begin(), below.end());
    s.pattern.column_start.push_back(s.pattern.non_zeros());
  }
  return s;
}

double energy_error(const System& s, const Vector& x, const Vector& exact) {
  const Vector e = x - exact;
  return std::sqrt(e.dot(s.multiply(e)) / exact.dot(s.multiply(exact)));
}

TEST_F(Petsc, SolutionsAreAsGoodAsTheirTolerance) {
  for (const System& s : {laplacian(10), points(5)})
    for (const std::string options : {"", "-pc_type gamg", "-pc_type icc", "-pc_type none"})
      for (const double relative : {1e-1, 1e-3, 1e-5, 1e-9}) {
        const auto solver = factored(s, options);
        const Vector exact = random_vector(random_, s.pattern.n);
        Vector x(s.pattern.n);
        solver->set_tolerance({relative});
        solver->solve(s.multiply(exact), x);
        // Factor 2: the solver can only estimate the reduction by the iterations that it omits.
        EXPECT_LE(energy_error(s, x, exact), 2 * relative) << options;
      }
}

TEST_F(Petsc, AnAbsoluteToleranceIsOneOfTheRootMeanSquare) {
  const System s = laplacian(12);
  const auto solver = factored(s);
  const Vector exact = random_vector(random_, s.pattern.n), b = s.multiply(exact);
  const double rms = exact.norm() / std::sqrt(static_cast<double>(s.pattern.n));
  Vector x(s.pattern.n);
  solver->set_tolerance({.relative = 1e-12, .absolute = 0.01 * rms});
  solver->solve(b, x);
  const double error = energy_error(s, x, exact);
  EXPECT_LE(error, 0.02);
  EXPECT_GE(error, 1e-6);  // not much better than requested
}

TEST_F(Petsc, SolvesInPlaceAndWithNewValues) {
  System s = points(4);
  const auto solver = factored(s);
  for (const double factor : {1.0, 1e6, 1e-9}) {
    for (double& value : s.values) value *= factor;
    for (int i = 0; i < s.pattern.n; ++i) diagonal(s, i) *= random_.between(1, 2);
    ASSERT_EQ(solver->factor(s.values.data()), FactorStatus::ok);
    const Vector exact = random_vector(random_, s.pattern.n);
    Vector x = s.multiply(exact);
    solver->solve(x, x);
    EXPECT_LE((x - exact).norm(), 1e-8 * exact.norm());
  }
}

TEST_F(Petsc, TakesAnotherPattern) {
  const System first = laplacian(3), second = points(3);
  const auto solver = factored(first);
  solver->analyze(second.pattern);
  ASSERT_EQ(solver->factor(second.values.data()), FactorStatus::ok);
  const Vector exact = random_vector(random_, second.pattern.n);
  Vector x(exact.size());
  solver->solve(second.multiply(exact), x);
  EXPECT_LE((x - exact).norm(), 1e-8 * exact.norm());
}

TEST_F(Petsc, SolvesForNothing) {
  const System s = laplacian(3);
  Vector x = Vector::Ones(s.pattern.n);
  factored(s)->solve(Vector::Zero(s.pattern.n), x);
  EXPECT_EQ(x, Vector::Zero(s.pattern.n));
}

// A chain of n masses. Its condition number is about n^2, too large for diagonal preconditioning.
TEST_F(Petsc, TakesMultigridWhereTheDiagonalIsNotEnough) {
  constexpr int n = 3000;
  System chain;
  chain.pattern.n = n;
  chain.pattern.column_start.push_back(0);
  for (int i = 0; i < n; ++i) {
    chain.pattern.row.push_back(i), chain.values.push_back(2);
    if (i + 1 < n) chain.pattern.row.push_back(i + 1), chain.values.push_back(-1);
    chain.pattern.column_start.push_back(chain.pattern.non_zeros());
  }
  const auto solver = factored(chain);
  EXPECT_NE(solver->description().find("diagonal blocks"), std::string::npos) << solver->description();
  const Vector exact = random_vector(random_, n), b = chain.multiply(exact);
  Vector x(n);
  solver->solve(b, x);
  EXPECT_NE(solver->description().find("multigrid"), std::string::npos) << solver->description();
  EXPECT_LE(energy_error(chain, x, exact), 1e-7);
}

// The matrices of a run are similar, so the multigrid hierarchy of the first one is reused until iterations increase.
TEST_F(Petsc, SetsMultigridUpAgainOnlyWhenItHasBecomeWorse) {
  System s = laplacian(12);
  const auto solver = factored(s, "-pc_type gamg");
  const auto solve_with = [&](double weight) {  // weight: factor of the first half of the points
    System now = s;
    for (int j = 0; j < now.pattern.n / 2; ++j)
      for (int k = now.pattern.column_start[static_cast<std::size_t>(j)];
           k < now.pattern.column_start[static_cast<std::size_t>(j) + 1]; ++k)
        now.values[static_cast<std::size_t>(k)] *= weight;
    for (int i = 0; i < now.pattern.n; ++i) diagonal(now, i) += 6 * weight;
    ASSERT_EQ(solver->factor(now.values.data()), FactorStatus::ok);
    Vector x(now.pattern.n);
    solver->set_tolerance({1e-8});
    solver->solve(Vector::Ones(now.pattern.n), x);
  };
  const auto set_ups = [&] {
    const std::string text = solver->description();
    return std::stoi(text.substr(text.find("set up ") + 7));
  };
  for (const double weight : {1.0, 1.01, 1.02, 1.03}) solve_with(weight);
  EXPECT_EQ(set_ups(), 1) << solver->description();
  for (const double weight : {1e4, 1e4, 1e4}) solve_with(weight);
  EXPECT_EQ(set_ups(), 2) << solver->description();
}

TEST_F(Petsc, FindsANegativeDiagonalAtOnce) {
  System s = laplacian(4);
  diagonal(s, 20) = -0.5;
  const auto solver = make_linear_solver("petsc");
  solver->analyze(s.pattern);
  EXPECT_EQ(solver->factor(s.values.data()), FactorStatus::not_positive_definite);
  diagonal(s, 20) = std::nan("");
  EXPECT_NE(solver->factor(s.values.data()), FactorStatus::ok);
}

// The Laplacian minus 1.7 times its smallest eigenvalue: indefinite, but with a positive diagonal.
TEST_F(Petsc, FindsAnIndefiniteMatrixOnItsWay) {
  System s = laplacian(6);
  for (int i = 0; i < s.pattern.n; ++i) diagonal(s, i) -= 1;
  const auto solver = factored(s);
  const Vector b = Vector::Ones(s.pattern.n);
  Vector x = Vector::Constant(s.pattern.n, 7);
  EXPECT_THROW(solver->solve(b, x), IndefiniteMatrix);
  EXPECT_EQ(x, Vector::Constant(s.pattern.n, 7));
}

// The symbolic analysis predicts the cost of a factor. It is small for a grid of 10^5 points. With as many points and
// random neighbours the factor would need too much memory and time.
TEST_F(Petsc, IsChosenWhereAFactorCostsMore) {
  const auto chosen = [](const System& s) {
    const auto solver = make_linear_solver({"auto"}, s.pattern);
    return solver->description();
  };
  EXPECT_TRUE(chosen(laplacian(47)).starts_with("cholesky:")) << chosen(laplacian(47));
  const std::string far = chosen(far_neighbours(random_, 101'000, 6));
  EXPECT_TRUE(far.starts_with("petsc:")) << far;
  EXPECT_NE(far.find("; a factor"), std::string::npos) << far;  // the reason
  EXPECT_EQ(chosen(laplacian(47)).find("; a factor"), std::string::npos);
  EXPECT_TRUE(chosen(far_neighbours(random_, 2'000, 6)).starts_with("cholesky:"));
}

TEST_F(Petsc, SaysThatItDoesNotConverge) {
  const System s = laplacian(12);
  const auto solver = factored(s, "-pc_type none -ksp_max_it 3");
  Vector x(s.pattern.n);
  try {
    solver->solve(random_vector(random_, s.pattern.n), x);
    FAIL() << "converged";
  } catch (const RecoverableError& e) {
    for (const char* part : {"does not converge", "3 iterations"})
      EXPECT_NE(std::string(e.what()).find(part), std::string::npos) << e.what();
  }
}

TEST_F(Petsc, TakesADirectFactorByOption) {
  for (const std::string package : {"", " -pc_factor_mat_solver_type mumps"}) {
    System s = points(4);
    const auto solver = factored(s, "-ksp_type preonly -pc_type cholesky" + package);
    for (const double factor : {1.0, 3.0}) {
      for (double& value : s.values) value *= factor;
      ASSERT_EQ(solver->factor(s.values.data()), FactorStatus::ok);
      const Vector exact = random_vector(random_, s.pattern.n);
      Vector x(exact.size());
      solver->solve(s.multiply(exact), x);
      EXPECT_LE((x - exact).norm(), 1e-12 * exact.norm()) << package;
    }
  }
}

TEST_F(Petsc, RefusesOptionsThatNobodyKnows) {
  for (const auto& [options, named] : std::vector<std::pair<std::string, std::string>>{
           {"-ksp_typ cg", "-ksp_typ"}, {"-pc_type nothing_like_it", "nothing_like_it"}, {"cg", "list of options"}}) {
    try {
      make_linear_solver({"petsc", options});
      ADD_FAILURE() << "accepted: " << options;
    } catch (const ConfigError& e) {
      EXPECT_NE(e.message().find(named), std::string::npos) << e.message();
    }
  }
}

// Options that write, read or wait: viewers, monitors and option files, also those of nested solvers.
TEST_F(Petsc, RefusesOptionsThatDoNotTuneAMethod) {
  const auto file = std::filesystem::path(testing::TempDir()) / "petsc_option";
  for (const std::string name : {"-ksp_view",
                                 "-ksp_view_mat",
                                 "-ksp_monitor",
                                 "-ksp_monitor_solution",
                                 "-ksp_converged_reason",
                                 "-ksp_converged_rate",
                                 "-mg_levels_ksp_view",
                                 "-mg_levels_1_ksp_monitor",
                                 "-mg_coarse_sub_ksp_view_rhs",
                                 "-sub_mg_levels_2_ksp_view",
                                 "-pc_hypre_mat_view",
                                 "-mat_view",
                                 "-mat_factor_view",
                                 "-log_view",
                                 "-info",
                                 "-options_view",
                                 "-options_file",
                                 "-mat_mumps_icntl_1",
                                 "-prefix_push",
                                 "-petsc_sleep",
                                 "--ksp_view"})
    for (const std::string& value : {":" + file.string(), "ascii:" + file.string(), file.string(), std::string("1")}) {
      std::ofstream(file) << "kept";
      EXPECT_THROW(make_linear_solver({"petsc", "-ksp_type cg " + name + " " + value}), ConfigError) << name << value;
      EXPECT_THROW(make_linear_solver({"petsc", "\t" + name + "\t" + value}), ConfigError) << name << value;
      std::string content;
      std::ifstream(file) >> content;
      EXPECT_EQ(content, "kept") << name << " " << value;
    }
  std::filesystem::remove(file);
}

TEST_F(Petsc, TakesOptionsOfSolversWithinSolvers) {
  for (const std::string options :
       {"-pc_type gamg -mg_levels_ksp_type richardson -mg_levels_pc_type sor -mg_coarse_pc_type lu",
        "-pc_type bjacobi -sub_pc_type ilu -sub_pc_factor_levels 1 -pc_bjacobi_blocks 2",
        "-pc_type asm -pc_asm_overlap 2 -sub_pc_factor_shift_amount -1e-30"})
    EXPECT_NO_THROW(make_linear_solver({"petsc", options})) << options;
}

// Child processes inherit the environment and may use MPI differently.
TEST_F(Petsc, LeavesTheEnvironmentAsItWas) {
  factored(laplacian(3));
  for (const char* name : {"OMPI_MCA_pml", "OMPI_MCA_btl", "OMPI_MCA_ess_singleton_isolated"})
    EXPECT_EQ(std::getenv(name), nullptr) << name;
  EXPECT_NE(std::getenv("PATH"), nullptr);
}

TEST_F(Petsc, GivesTheSameBitsAgain) {
  const System s = points(6);
  const Vector b = random_vector(random_, s.pattern.n);
  Vector x(s.pattern.n), again(s.pattern.n);
  factored(s)->solve(b, x);
  factored(s)->solve(b, again);
  EXPECT_EQ(x, again);
}

}  // namespace
}  // namespace orthodyn::petsc_test
