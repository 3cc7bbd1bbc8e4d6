#include "integrators/constraint_complement.h"

namespace orthodyn {

bool ConstraintComplement::factor(const std::function<void(const Vector& b, Vector& x)>& solve) {
  Y_.resize(G_.rows(), G_.cols());
  Vector x(G_.rows());
  for (Eigen::Index k = 0; k < G_.cols(); ++k) {
    solve(Vector(G_.col(k)), x);
    Y_.col(k) = x;
  }
  S_.compute(G_.transpose() * Y_);
  return S_.info() == Eigen::Success;
}

std::size_t ConstraintComplement::bytes() const {
  return static_cast<std::size_t>(Y_.size() + 2 * Y_.cols() * Y_.cols()) * sizeof(double);
}

}  // namespace orthodyn
