#include "lib/linear/negative_eigenpairs.h"

#include <Spectra/SymGEigsSolver.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "lib/core/errors.h"
#include "lib/core/symmetric_eigen.h"
#include "lib/linear/solver.h"
#include "lib/linear/unit_scale.h"

namespace orthodyn {

namespace {

constexpr int kDenseUnknowns = 300;
constexpr double kRough = 1e-2;  // tolerance from which on a small basis suffices

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

NegativeEigenPairs first_below(const NegativeEigenPairs& pairs, double bound) {
  const Eigen::Index count = (pairs.values.array() < bound).count();
  return {pairs.values.head(count), pairs.shapes.leftCols(count)};
}

NegativeEigenPairs dense_pairs(const Pattern& pattern, const std::vector<double>& A, const std::vector<double>& B,
                               double bound, int count) {
  const auto pairs = symmetric_eigenpairs(dense_symmetric(pattern, A), dense_symmetric(pattern, B));
  const Eigen::Index most = std::min<Eigen::Index>(count, pairs.values.size());
  return first_below({pairs.values.head(most), pairs.vectors.leftCols(most)}, bound);
}

// Empty if the iteration does not converge.
std::optional<NegativeEigenPairs> lanczos(SymmetricProduct a, DefiniteOperator& b, int count, Spectra::SortRule rule,
                                          double tolerance, int most_restarts) {
  const int basis = std::min(a.pattern.n, tolerance < kRough ? std::max(4 * count, 40) : 4 * count + 8);
  Spectra::SymGEigsSolver<SymmetricProduct, DefiniteOperator, Spectra::GEigsMode::RegularInverse> solver(a, b, count,
                                                                                                         basis);
  solver.init();
  solver.compute(rule, most_restarts, tolerance, Spectra::SortRule::SmallestAlge);
  if (solver.info() != Spectra::CompInfo::Successful) return std::nullopt;
  return NegativeEigenPairs{solver.eigenvalues(), solver.eigenvectors()};
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

// The `count` lowest eigenpairs below `bound`, or as many as there are. Precondition: A and B are scaled so that B and
// B^-1 A are of size one.
NegativeEigenPairs lanczos_pairs(const Pattern& pattern, const std::vector<double>& A, const std::vector<double>& B,
                                 LinearSolver& solver, double bound, int count) {
  constexpr int kMostRestarts = 300, kFirstRestarts = 20, kMostUncounted = 20;
  const SymmetricProduct a{pattern, A}, b{pattern, B};
  DefiniteOperator inverse{b, solver};
  // Spectra's tolerance is relative to each eigenvalue, which is too strict for those near zero. Shifting all
  // eigenvalues by a little more than the largest magnitude makes the tolerance relative to that magnitude.
  const auto largest = lanczos(a, inverse, 1, Spectra::SortRule::LargestMagn, kRough, kMostRestarts);
  if (!largest) throw RunError("the Lanczos iteration does not find the largest eigenvalue");
  const double raised = 1.1 * std::abs(largest->values[0]);
  const auto positive = sum(A, raised, B);
  const auto lowest = [&](int wanted, int restarts) {
    auto pairs = lanczos({pattern, positive}, inverse, wanted, Spectra::SortRule::SmallestAlge, 1e-10, restarts);
    if (pairs) pairs->values.array() -= raised;
    return pairs;
  };
  // Counting the eigenvalues below the bound takes an indefinite factor, which costs more than the iteration for a few
  // pairs. If it converges, the lowest are found, whether they are below the bound or not.
  if (count <= kMostUncounted)
    if (const auto pairs = lowest(count, kFirstRestarts)) return first_below(*pairs, bound);
  count = std::min({count, count_below(pattern, A, B, bound), pattern.n - 1});
  if (count == 0) return {};
  auto pairs = lowest(count, kMostRestarts);
  if (!pairs)
    throw RunError(fmt::format("{} eigenpairs did not converge in {} restarts of the Lanczos iteration; request fewer",
                               count, kMostRestarts));
  return *std::move(pairs);
}

}  // namespace

NegativeEigenPairs negative_eigenpairs(const Pattern& pattern, const std::vector<double>& A_given,
                                       const std::vector<double>& B_given, double bound, int count) {
  if (!pattern.symmetric) throw ConfigError("needs a symmetric stiffness");
  const double unit_of_B = nearest_power_of_two(diagonal(pattern, B_given).mean());
  const auto B = divided(B_given, unit_of_B);
  const auto solver = make_solver_for(pattern);
  if (solver->factor(B.data()) != FactorStatus::ok) throw RunError("the stiffness is not positive definite");
  const double unit = nearest_power_of_two(operator_norm(
      pattern.n, [&](const Vector& x, Vector& y) { pattern.multiply(A_given.data(), x, y); },
      [&](const Vector& y, Vector& x) { solver->solve(y / unit_of_B, x); }));
  const auto A = divided(A_given, unit * unit_of_B);
  NegativeEigenPairs pairs = pattern.n <= kDenseUnknowns ? dense_pairs(pattern, A, B, -bound / unit, count)
                                                         : lanczos_pairs(pattern, A, B, *solver, -bound / unit, count);
  if (pairs.values.size() == 0) return {};
  pairs.values *= unit;
  pairs.shapes /= std::sqrt(unit_of_B);
  return pairs;
}

}  // namespace orthodyn
