#include "lib/linear/eigenmodes.h"

#include <Spectra/SymGEigsShiftSolver.h>
#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <optional>
#include <string>
#include <utility>

#include "lib/core/errors.h"
#include "lib/core/memory.h"
#include "lib/core/symmetric_eigen.h"
#include "lib/linear/solver.h"

namespace orthodyn {

namespace {

constexpr int kDense = 300;          // unknowns up to which the dense problem is solved
constexpr double kZero = 2.5e-14;    // of the largest eigenvalue
constexpr double kFirstShift = 1e-10;  // likewise
constexpr double kMostShift = 10;
constexpr int kRigid = 6;
constexpr double kAccuracy = 1e-11;  // of an iterative solver

std::unique_ptr<LinearSolver> make_iterative(const Pattern& pattern) {
  return make_linear_solver({"petsc", "-pc_type gamg -pc_gamg_agg_nsmooths 0 -ksp_max_it 5000"}, pattern);
}

// A hundred solutions and more are wanted to many digits, for which a factor is made if it can be.
std::unique_ptr<LinearSolver> factor_or_iterations(const Pattern& pattern) {
  constexpr double kMostOfMemory = 0.8;
  const bool has_other = solver_registry().at("petsc").unavailable.empty();
  try {
    auto solver = make_solver_for(pattern);
    if (!has_other || static_cast<double>(solver->factor_bytes()) <= kMostOfMemory * memory_left()) return solver;
  } catch (const RunError&) {  // it cannot even be analysed
    if (!has_other) throw;
  }
  try {
    return make_iterative(pattern);
  } catch (const ConfigError&) {  // it cannot be loaded here
    return make_solver_for(pattern);
  }
}

class Problem {
 public:
  Problem(const Pattern& pattern, const std::vector<double>& K, const std::vector<double>& M,
          const SoftestMotions& softest, ShiftedSolver solver)
      : pattern_(pattern), K_(K), M_(M), shifted_(K.size()),
        solver_(solver == ShiftedSolver::iterative ? make_iterative(pattern) : factor_or_iterations(pattern)) {
    if (!solver_->is_iterative()) return;
    solver_->set_tolerance({kAccuracy, 0});
    if (softest) softest_ = softest();
  }

  int size() const { return pattern_.n; }
  std::string solver() const { return solver_->description(); }
  void multiply_mass(const ConstVectorRef& x, VectorRef y) const { pattern_.multiply(M_.data(), x, y); }
  void solve_shifted(const ConstVectorRef& b, VectorRef x) const { solver_->solve(b, x); }

  // Factors K + s M, if it is not the last one; false if it is not positive definite.
  bool shift(double s) {
    if (shift_ == s) return is_definite_;
    shift_ = s;
    is_definite_ = false;
    for (std::size_t k = 0; k < K_.size(); ++k) shifted_[k] = K_[k] + s * M_[k];
    if (solver_->is_iterative()) solver_->set_rigid_motions(softest_);
    is_definite_ = solver_->factor(shifted_.data()) == FactorStatus::ok;
    return is_definite_;
  }

  Eigen::MatrixXd dense(const std::vector<double>& values) const {
    const Eigen::MatrixXd stored(pattern_.matrix(values.data()));
    return stored.selfadjointView<Eigen::Lower>();
  }
  const std::vector<double>& K() const { return K_; }
  const std::vector<double>& M() const { return M_; }

  // The size of the largest eigenvalue, from below: of the stiffest coordinate on its own.
  double largest() const {
    double largest = 0;
    for (const int diagonal : pattern_.column_start) {  // of each lower triangle's column the first entry
      const auto at = static_cast<std::size_t>(diagonal);
      if (at < K_.size()) largest = std::max(largest, std::abs(K_[at] / M_[at]));
    }
    return largest;
  }

 private:
  const Pattern& pattern_;
  const std::vector<double>&K_, &M_;
  Eigen::MatrixXd softest_;
  std::vector<double> shifted_;
  std::optional<double> shift_;  // of `shifted_`
  bool is_definite_ = false;
  std::unique_ptr<LinearSolver> solver_;
};

// As Spectra wants its operators.
struct Inverse {
  using Scalar = double;
  Problem& problem;
  Eigen::Index rows() const { return problem.size(); }
  Eigen::Index cols() const { return problem.size(); }
  void set_shift(double sigma) { problem.shift(-sigma); }
  void perform_op(const double* in, double* out) const {
    problem.solve_shifted(Eigen::Map<const Vector>(in, rows()), Eigen::Map<Vector>(out, rows()));
  }
};
struct MassProduct {
  using Scalar = double;
  const Problem& problem;
  Eigen::Index rows() const { return problem.size(); }
  Eigen::Index cols() const { return problem.size(); }
  void perform_op(const double* in, double* out) const {
    problem.multiply_mass(Eigen::Map<const Vector>(in, rows()), Eigen::Map<Vector>(out, rows()));
  }
};

EigenPairs lanczos(Problem& problem, double shift, int count) {
  Inverse inverse{problem};
  MassProduct mass{problem};
  const int basis = std::min(problem.size(), std::max(2 * count + 10, 30));
  Spectra::SymGEigsShiftSolver<Inverse, MassProduct, Spectra::GEigsMode::ShiftInvert> solver(inverse, mass, count,
                                                                                             basis, -shift);
  solver.init();
  constexpr int kRestarts = 1000;
  const auto found = solver.compute(Spectra::SortRule::LargestMagn, kRestarts, 1e-12, Spectra::SortRule::SmallestAlge);
  if (solver.info() != Spectra::CompInfo::Successful)
    throw RunError(fmt::format("{} of {} modes converged in {} restarts of the Lanczos iteration; ask for fewer modes",
                               found, count, kRestarts));
  return {solver.eigenvalues(), solver.eigenvectors()};
}

EigenPairs dense(const Problem& problem, int count) {
  const auto pairs = symmetric_eigenpairs(problem.dense(problem.K()), problem.dense(problem.M()));
  return {pairs.values.head(count), pairs.vectors.leftCols(count)};
}

int zeros_among(const Vector& values, double largest) {
  return static_cast<int>((values.array().abs() <= kZero * largest).count());
}

std::optional<EigenPairs> lanczos_if_definite(Problem& problem, double shift, int count) {
  try {
    if (problem.shift(shift)) return lanczos(problem, shift, count);
  } catch (const IndefiniteMatrix&) {  // as an iterative solver finds out on its way only
  }
  return std::nullopt;
}

// With the smallest shift that makes K + s M positive definite.
EigenPairs first_pass(Problem& problem, double largest, int count, double& shift) {
  for (shift = kFirstShift * largest; shift <= kMostShift * largest; shift *= 100)
    if (auto pairs = lanczos_if_definite(problem, shift, count)) return std::move(*pairs);
  throw RunError("the stiffness is far from positive definite: modes about this state cannot be computed");
}

EigenPairs sparse(Problem& problem, double largest, int count) {
  double shift = 0;
  const int wanted = std::min(problem.size() - 1, count + kRigid + 1);
  EigenPairs pairs = first_pass(problem, largest, wanted, shift);
  const int zeros = zeros_among(pairs.values, largest);
  if (zeros == 0 || zeros == wanted) return pairs;
  const double lowest = pairs.values.tail(pairs.values.size() - zeros).cwiseAbs().minCoeff();
  if (!(lowest > shift)) return pairs;
  // Zeros no longer stand out there, and Lanczos' method may find one of several equal eigenvalues too few.
  for (int more = wanted; more <= std::min(problem.size() - 1, wanted + 3 * kRigid); more += kRigid)
    if (auto again = lanczos_if_definite(problem, lowest, more); again && zeros_among(again->values, largest) >= zeros)
      return std::move(*again);
  return pairs;
}

EigenPairs sparse_or_failure(Problem& problem, double largest, int count) {
  try {
    return sparse(problem, largest, count);
  } catch (const RecoverableError& e) {
    throw RunError(std::string("modes: ") + e.what());
  }
}

}  // namespace

EigenPairs lowest_eigenpairs(const Pattern& pattern, const std::vector<double>& K, const std::vector<double>& M,
                             int count, const SoftestMotions& softest, ShiftedSolver solver) {
  if (!pattern.symmetric) throw ConfigError("modes need a symmetric stiffness");
  if (count > pattern.n)
    throw ConfigError(
        fmt::format("{} modes were requested, but there are {} unknowns and as many modes", count, pattern.n));
  Problem problem(pattern, K, M, softest, solver);
  const double largest = problem.largest();
  const bool small = pattern.n <= kDense || count + kRigid + 1 >= pattern.n / 2;
  EigenPairs pairs = small ? dense(problem, count) : sparse_or_failure(problem, largest, count);
  pairs.values.conservativeResize(count);
  pairs.shapes.conservativeResize(Eigen::NoChange, count);
  pairs.zeros = zeros_among(pairs.values, largest);
  pairs.resolution = kZero * largest;
  pairs.solver = small ? "dense" : problem.solver();
  for (double& value : pairs.values)
    if (std::abs(value) <= pairs.resolution) value = 0;
  return pairs;
}

}  // namespace orthodyn
