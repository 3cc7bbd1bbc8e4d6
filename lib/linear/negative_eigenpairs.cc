#include "lib/linear/negative_eigenpairs.h"

#include <Spectra/SymGEigsSolver.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "lib/core/errors.h"
#include "lib/core/symmetric_eigen.h"
#include "lib/linear/solver.h"
#include "lib/linear/unit_scale.h"

namespace orthodyn {

namespace {

constexpr int kDenseUnknowns = 300;

// Operators for Spectra: A x, and B with its solver.
struct SymmetricProduct {
  using Scalar = double;
  const Pattern& pattern;
  const std::vector<double>& values;
  Eigen::Index rows() const { return pattern.n; }
  Eigen::Index cols() const { return pattern.n; }
  void perform_op(const double* in, double* out) const {
    pattern.multiply(values.data(), Eigen::Map<const Vector>(in, rows()), Eigen::Map<Vector>(out, rows()));
  }
};

struct DefiniteOperator {
  using Scalar = double;
  const SymmetricProduct& product;
  LinearSolver& solver;
  Eigen::Index rows() const { return product.rows(); }
  Eigen::Index cols() const { return product.cols(); }
  void perform_op(const double* in, double* out) const { product.perform_op(in, out); }
  void solve(const double* in, double* out) const {
    solver.solve(Eigen::Map<const Vector>(in, rows()), Eigen::Map<Vector>(out, rows()));
  }
};

NegativeEigenPairs dense_pairs(const Pattern& pattern, const std::vector<double>& A, const std::vector<double>& B,
                               int count) {
  const auto pairs = symmetric_eigenpairs(dense_symmetric(pattern, A), dense_symmetric(pattern, B));
  return {pairs.values.head(count), pairs.vectors.leftCols(count)};
}

NegativeEigenPairs lanczos(SymmetricProduct a, DefiniteOperator& b, int count, Spectra::SortRule rule,
                           double tolerance) {
  const int basis = std::min(a.pattern.n, std::max(4 * count, 40));
  Spectra::SymGEigsSolver<SymmetricProduct, DefiniteOperator, Spectra::GEigsMode::RegularInverse> solver(a, b, count,
                                                                                                         basis);
  solver.init();
  constexpr int kMostRestarts = 300;
  const auto found = solver.compute(rule, kMostRestarts, tolerance, Spectra::SortRule::SmallestAlge);
  if (solver.info() != Spectra::CompInfo::Successful)
    throw RunError(fmt::format("{} of {} eigenpairs converged in {} restarts of the Lanczos iteration; request fewer",
                               found, count, kMostRestarts));
  return {solver.eigenvalues(), solver.eigenvectors()};
}

// A + s B
std::vector<double> sum(const std::vector<double>& A, double s, const std::vector<double>& B) {
  std::vector<double> out(A);
  for (std::size_t k = 0; k < A.size(); ++k) out[k] += s * B[k];
  return out;
}

// Number of eigenvalues nu < bound: the number of negative eigenvalues of A - bound B (Sylvester's law of inertia).
int count_below(const Pattern& pattern, const std::vector<double>& A, const std::vector<double>& B, double bound) {
  const auto solver = make_indefinite_solver(pattern);
  if (solver->factor(sum(A, -bound, B).data()) != FactorStatus::ok)
    throw RunError("the matrix is singular next to an eigenvalue of zero");
  return solver->negative_eigenvalues();
}

std::vector<double> divided(const std::vector<double>& values, double by) {
  std::vector<double> out(values);
  for (double& value : out) value /= by;
  return out;
}

// Precondition: A and B are scaled so that B and B^-1 A are of size one.
NegativeEigenPairs lanczos_pairs(const Pattern& pattern, const std::vector<double>& A, const std::vector<double>& B,
                                 LinearSolver& solver, int count) {
  const SymmetricProduct a{pattern, A}, b{pattern, B};
  DefiniteOperator inverse{b, solver};
  // Spectra's tolerance is relative to each eigenvalue, which is too strict for those near zero. Shifting all
  // eigenvalues by a little more than the largest magnitude makes the tolerance relative to that magnitude.
  const double raised = 1.1 * std::abs(lanczos(a, inverse, 1, Spectra::SortRule::LargestMagn, 1e-2).values[0]);
  const auto positive = sum(A, raised, B);
  NegativeEigenPairs pairs = lanczos({pattern, positive}, inverse, count, Spectra::SortRule::SmallestAlge, 1e-10);
  pairs.values.array() -= raised;
  return pairs;
}

}  // namespace

NegativeEigenPairs negative_eigenpairs(const Pattern& pattern, const std::vector<double>& A_given,
                                       const std::vector<double>& B_given, double bound, int count) {
  if (!pattern.symmetric) throw ConfigError("needs a symmetric stiffness");
  const double unit_of_B = nearest_power_of_two(diagonal(pattern, B_given).mean());
  const auto B = divided(B_given, unit_of_B);
  const auto solver = make_linear_solver("cholmod", pattern);
  if (solver->factor(B.data()) != FactorStatus::ok) throw RunError("the stiffness is not positive definite");
  const double unit = nearest_power_of_two(operator_norm(
      pattern.n, [&](const Vector& x, Vector& y) { pattern.multiply(A_given.data(), x, y); },
      [&](const Vector& y, Vector& x) { solver->solve(y / unit_of_B, x); }));
  const auto A = divided(A_given, unit * unit_of_B);
  count = std::min(count, count_below(pattern, A, B, -bound / unit));
  if (count == 0) return {};
  NegativeEigenPairs pairs =
      pattern.n <= kDenseUnknowns ? dense_pairs(pattern, A, B, count) : lanczos_pairs(pattern, A, B, *solver, count);
  pairs.values *= unit;
  pairs.shapes /= std::sqrt(unit_of_B);
  return pairs;
}

}  // namespace orthodyn
