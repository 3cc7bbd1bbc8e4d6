#include "lib/simulation/sensitivity/nelson_system.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "lib/core/errors.h"

namespace orthodyn {

NelsonSystem::NelsonSystem(const Pattern& pattern, const std::vector<double>& K, const std::vector<double>& M,
                           double lambda, const Vector& shape)
    : pattern_(pattern), values_(K.size()) {
  shape.cwiseAbs().maxCoeff(&fixed_);
  for (std::size_t k = 0; k < K.size(); ++k) values_[k] = K[k] - lambda * M[k];
  double largest = 0;
  for (const double value : values_) largest = std::max(largest, std::abs(value));
  for (int column = 0; column < pattern.n; ++column) {
    const auto at = static_cast<std::size_t>(column);
    for (int k = pattern.column_start[at]; k < pattern.column_start[at + 1]; ++k) {
      const int row = pattern.row[static_cast<std::size_t>(k)];
      if (row == fixed_ || column == fixed_) values_[static_cast<std::size_t>(k)] = row == column ? largest : 0;
    }
  }
  // Without pivoting for size, which is faster; solve() checks the accuracy.
  solver_ = make_indefinite_solver(pattern_);
  if (solver_->factor(values_.data()) != FactorStatus::ok) factor_with_pivots();
}

void NelsonSystem::factor_with_pivots() {
  pivots_ = true;
  solver_ = make_linear_solver("klu", pattern_);
  if (solver_->factor(values_.data()) != FactorStatus::ok)
    throw RunError("a shape has no derivative: the stiffness less that of inertia is singular beside the shape");
}

// Iterative refinement until the correction does not decrease any more, which is then the rounding error.
bool NelsonSystem::try_to_solve(const Vector& b, Vector& z) const {
  constexpr int kMostRefinements = 8;
  constexpr double kAccurate = 1e-6;  // of z
  z = Vector::Zero(b.size());
  Vector product(b.size()), correction(b.size());
  double before = std::numeric_limits<double>::infinity(), error = before;
  for (int i = 0; i < kMostRefinements; ++i) {
    pattern_.multiply(values_.data(), z, product);
    solver_->solve(b - product, correction);
    if (!correction.allFinite()) return false;
    error = correction.norm();
    if (i > 1 && error > before / 2) break;
    z += correction;
    before = error;
  }
  return error <= kAccurate * z.norm();
}

Vector NelsonSystem::solve(Vector b) {
  b[fixed_] = 0;
  if (b.isZero(0)) return b;
  Vector z;
  if (try_to_solve(b, z)) return z;
  if (!pivots_) {
    factor_with_pivots();
    if (try_to_solve(b, z)) return z;
  }
  throw RunError("the derivative of a shape could not be computed: the linear system is too ill-conditioned");
}

}  // namespace orthodyn
