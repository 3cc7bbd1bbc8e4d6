#include "lib/linear/eigenmodes.h"

#include <Spectra/SymGEigsShiftSolver.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <utility>

#include "lib/core/errors.h"
#include "lib/core/memory.h"
#include "lib/core/symmetric_eigen.h"
#include "lib/linear/solver.h"
#include "lib/linear/unit_scale.h"

namespace orthodyn {

namespace {

constexpr int kMaxDense = 300;  // largest number of unknowns for which the dense problem is solved
// Relative to the largest eigenvalue:
constexpr double kZero = 2.5e-14;
constexpr double kFirstShift = 1e-10, kLastShift = 10;
constexpr double kRoundOff = 1e-13;

constexpr double kMaxResidual = 1e-6;
constexpr int kNumRigid = 6;
constexpr double kAccuracy = 1e-11;  // relative tolerance of an iterative solver

std::unique_ptr<LinearSolver> make_iterative(const Pattern& pattern) {
  return make_linear_solver({"petsc", "-pc_type gamg -pc_gamg_agg_nsmooths 0 -ksp_max_it 5000"}, pattern);
}

// Makes a solver by a factor if the factor fits in memory, because 100 or more accurate solutions are needed; else an
// iterative solver. The decision uses memory_limit(), not the free memory, so that the same problem is always solved in
// the same way.
std::unique_ptr<LinearSolver> factor_or_iterations(const Pattern& pattern) {
  constexpr double kMaxFactorShare = 0.8;
  const bool has_petsc = solver_registry().at("petsc").unavailable.empty();
  try {
    auto solver = make_solver_for(pattern);
    if (!has_petsc || static_cast<double>(solver->factor_bytes()) <= kMaxFactorShare * memory_limit()) return solver;
  } catch (const RunError&) {  // the analysis failed
    if (!has_petsc) throw;
  }
  try {
    return make_iterative(pattern);
  } catch (const ConfigError&) {  // PETSc cannot be loaded
    return make_solver_for(pattern);
  }
}

bool is_diagonal(const Pattern& pattern, const std::vector<double>& M) {
  for (int column = 0; column < pattern.n; ++column)
    for (int k = pattern.column_start[static_cast<std::size_t>(column)];
         k < pattern.column_start[static_cast<std::size_t>(column) + 1]; ++k)
      if (pattern.row[static_cast<std::size_t>(k)] != column && M[static_cast<std::size_t>(k)] != 0) return false;
  return true;
}

// The eigenvalue problem scaled such that absolute thresholds of libraries become relative ones. Unit of mass: the mean
// diagonal entry of M; unit of eigenvalues: the largest quotient K_ii / M_ii, a lower estimate of the largest
// eigenvalue. Both are rounded to powers of two, so that scaling causes no rounding errors.
class Problem {
 public:
  Problem(const Pattern& pattern, const std::vector<double>& K, const std::vector<double>& M,
          const RigidMotions& rigid_motions, ShiftedSolver solver)
      : pattern_(pattern),
        K_(K),
        M_(M),
        shifted_(K.size()),
        solver_(solver == ShiftedSolver::iterative ? make_iterative(pattern) : factor_or_iterations(pattern)) {
    const Vector k = diagonal(pattern, K).cwiseAbs(), m = diagonal(pattern, M);
    if (is_diagonal(pattern, M)) lumped_mass_ = m;
    mass_unit_ = nearest_power_of_two(m.mean());
    unit_ = nearest_power_of_two(k.cwiseQuotient(m).maxCoeff());
    if (!solver_->is_iterative()) return;
    solver_->set_tolerance({kAccuracy, 0});
    if (rigid_motions) rigid_motions_ = rigid_motions();
  }

  int size() const { return pattern_.n; }
  std::string solver() const { return solver_->description(); }
  double unit() const { return unit_; }            // unit of eigenvalues, 1/s^2
  double mass_unit() const { return mass_unit_; }  // kg

  // The following functions use the scaled units.
  void multiply_mass(const ConstVectorRef& x, VectorRef y) const {
    if (lumped_mass_.size() > 0) y = lumped_mass_.cwiseProduct(x);
    else pattern_.multiply(M_.data(), x, y);
    y /= mass_unit_;
  }
  void multiply_stiffness(const ConstVectorRef& x, VectorRef y) const {
    pattern_.multiply(K_.data(), x, y);
    y /= mass_unit_ * unit_;
  }
  // x = (K + s M)^-1 b for the shift s of the last shift().
  void solve_shifted(const ConstVectorRef& b, VectorRef x) const { solver_->solve(b, x); }

  // Factors K + s M unless s was the last shift. False if K + s M is not positive definite.
  bool shift(double s) {
    if (shift_ == s) return is_definite_;
    shift_ = s;
    is_definite_ = false;
    const double k = 1 / (mass_unit_ * unit_), m = s / mass_unit_;
    for (std::size_t i = 0; i < K_.size(); ++i) shifted_[i] = k * K_[i] + m * M_[i];
    if (solver_->is_iterative()) solver_->set_rigid_motions(rigid_motions_);
    is_definite_ = solver_->factor(shifted_.data()) == FactorStatus::ok;
    return is_definite_;
  }

  Eigen::MatrixXd dense_stiffness() const { return dense_symmetric(pattern_, K_) / (mass_unit_ * unit_); }
  Eigen::MatrixXd dense_mass() const { return dense_symmetric(pattern_, M_) / mass_unit_; }

 private:
  const Pattern& pattern_;
  const std::vector<double>&K_, &M_;
  Vector lumped_mass_;  // the diagonal of M; empty if M has other entries
  double mass_unit_ = 1, unit_ = 1;
  Eigen::MatrixXd rigid_motions_;
  std::vector<double> shifted_;
  std::optional<double> shift_;  // s of shifted_ = K + s M
  bool is_definite_ = false;
  std::unique_ptr<LinearSolver> solver_;
};

// The operator scale (K + s M)^-1 for Spectra.
struct Inverse {
  using Scalar = double;
  const Problem& problem;
  double scale;
  Eigen::Index rows() const { return problem.size(); }
  Eigen::Index cols() const { return problem.size(); }
  void set_shift(double) {}  // Problem::shift() has set it
  void perform_op(const double* in, double* out) const {
    Eigen::Map<Vector> x(out, rows());
    problem.solve_shifted(Eigen::Map<const Vector>(in, rows()), x);
    x *= scale;
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

// An estimate of the largest eigenvalue of (K + s M)^-1 M.
double size_of_inverse(const Problem& problem) {
  const auto multiply = [&](const Vector& x, Vector& y) { problem.multiply_mass(x, y); };
  return operator_norm(problem.size(), multiply, [&](const Vector& b, Vector& x) { problem.solve_shifted(b, x); });
}

// Precondition: the last problem.shift() was `shift`.
EigenPairs lanczos(const Problem& problem, double shift, int count) {
  const double scale = 1 / size_of_inverse(problem);  // scales the operator's largest eigenvalue to about one
  Inverse inverse{problem, scale};
  MassProduct mass{problem};
  const int basis = std::min(problem.size(), std::max(2 * count + 10, 30));
  Spectra::SymGEigsShiftSolver<Inverse, MassProduct, Spectra::GEigsMode::ShiftInvert> solver(inverse, mass, count,
                                                                                             basis, -shift / scale);
  solver.init();
  constexpr int kRestarts = 1000;
  const auto found = solver.compute(Spectra::SortRule::LargestMagn, kRestarts, 1e-12, Spectra::SortRule::SmallestAlge);
  if (solver.info() != Spectra::CompInfo::Successful)
    throw RunError(fmt::format("{} of {} modes converged in {} restarts of the Lanczos iteration; request fewer modes",
                               found, count, kRestarts));
  return {scale * solver.eigenvalues(), solver.eigenvectors()};
}

EigenPairs dense(const Problem& problem, int count) {
  const auto pairs = symmetric_eigenpairs(problem.dense_stiffness(), problem.dense_mass());
  return {pairs.values.head(count), pairs.vectors.leftCols(count)};
}

int zeros_among(const Vector& values) { return static_cast<int>((values.array().abs() <= kZero).count()); }

std::optional<EigenPairs> lanczos_if_definite(Problem& problem, double shift, int count) {
  try {
    if (problem.shift(shift)) return lanczos(problem, shift, count);
  } catch (const IndefiniteMatrix&) {  // thrown by iterative solvers
  }
  return std::nullopt;
}

// Tries growing shifts s until K + s M is positive definite.
EigenPairs first_pass(Problem& problem, int count, double& shift) {
  for (shift = kFirstShift; shift <= kLastShift; shift *= 100)
    if (auto pairs = lanczos_if_definite(problem, shift, count)) return std::move(*pairs);
  throw RunError("the stiffness is far from positive definite: modes about this state cannot be computed");
}

EigenPairs sparse(Problem& problem, int count) {
  double shift = 0;
  const int wanted = std::min(problem.size() - 1, count + kNumRigid + 1);
  EigenPairs pairs = first_pass(problem, wanted, shift);
  const int zeros = zeros_among(pairs.values);
  if (zeros == 0 || zeros == wanted) return pairs;
  const double lowest = pairs.values.tail(pairs.values.size() - zeros).cwiseAbs().minCoeff();
  if (!(lowest > shift)) return pairs;
  // With this shift, zeros are less separated, and the Lanczos iteration may miss one of several equal eigenvalues.
  // More eigenvalues are then requested.
  for (int more = wanted; more <= std::min(problem.size() - 1, wanted + 3 * kNumRigid); more += kNumRigid)
    if (auto again = lanczos_if_definite(problem, lowest, more); again && zeros_among(again->values) >= zeros)
      return std::move(*again);
  return pairs;
}

EigenPairs sparse_or_failure(Problem& problem, int count) {
  try {
    return sparse(problem, count);
  } catch (const RecoverableError& e) {
    throw RunError(std::string("modes: ") + e.what());
  }
}

// Relative residuals. Throws RunError if one exceeds the tolerance and round-off.
Vector checked_residuals(const Problem& problem, const EigenPairs& pairs) {
  double lowest = 0;  // lowest nonzero eigenvalue
  for (const double value : pairs.values)
    if (lowest == 0) lowest = std::abs(value);
  Vector residuals = Vector::Zero(pairs.values.size());
  Vector stiff(problem.size()), inert(problem.size());
  for (Eigen::Index k = 0; k < residuals.size(); ++k) {
    const double reference = std::max(std::abs(pairs.values[k]), lowest);
    if (reference == 0) continue;
    problem.multiply_stiffness(pairs.shapes.col(k), stiff);
    problem.multiply_mass(pairs.shapes.col(k), inert);
    residuals[k] = (stiff - pairs.values[k] * inert).norm() / (reference * inert.norm());
    if (!(residuals[k] <= kMaxResidual + kRoundOff / reference))
      throw RunError(fmt::format(
          "mode {} was not found: the relative residual of K x = lambda M x is {:.2g}; request another number of modes",
          k + 1, residuals[k]));
  }
  return residuals;
}

}  // namespace

EigenPairs lowest_eigenpairs(const Pattern& pattern, const std::vector<double>& K, const std::vector<double>& M,
                             int count, const RigidMotions& rigid_motions, ShiftedSolver solver) {
  if (!pattern.symmetric) throw ConfigError("modes need a symmetric stiffness");
  if (count > pattern.n)
    throw ConfigError(
        fmt::format("{} modes were requested, but there are {} unknowns and as many modes", count, pattern.n));
  Problem problem(pattern, K, M, rigid_motions, solver);
  const bool small = pattern.n <= kMaxDense || count + kNumRigid + 1 >= pattern.n / 2;
  EigenPairs pairs = small ? dense(problem, count) : sparse_or_failure(problem, count);
  pairs.values.conservativeResize(count);
  pairs.shapes.conservativeResize(Eigen::NoChange, count);
  pairs.solver = small ? "dense" : problem.solver();
  pairs.zeros = zeros_among(pairs.values);
  pairs.values = (pairs.values.array().abs() <= kZero).select(0, pairs.values);
  pairs.residuals = checked_residuals(problem, pairs);
  pairs.resolution = kZero * problem.unit();
  pairs.values *= problem.unit();
  pairs.shapes /= std::sqrt(problem.mass_unit());
  return pairs;
}

int more_modes(int count, double reached, double limit) {
  constexpr double kMargin = 1.15, kFewest = 1.25, kMost = 4;
  const double growth = kMargin * std::sqrt(limit / std::max(reached, limit / 100));
  return static_cast<int>(std::ceil(count * std::clamp(growth, kFewest, kMost)));
}

}  // namespace orthodyn
