#include "integrators/sundials/constraint_solve.h"

namespace orthodyn::sundials {

void ConstraintSolve::linearize(double t, const ConstVectorRef& q) {
  G_ = constraints_.jacobian(t, q);
  H_.compute(Eigen::MatrixXd(G_.transpose() * G_));
}

bool ConstraintSolve::factor(const std::function<void(const Vector& b, Vector& x)>& solve) {
  Y_.resize(G_.rows(), G_.cols());
  Vector x(G_.rows());
  for (Eigen::Index k = 0; k < G_.cols(); ++k) {
    solve(Vector(G_.col(k)), x);
    Y_.col(k) = x;
  }
  S_.compute(G_.transpose() * Y_);
  return S_.info() == Eigen::Success;
}

void ConstraintSolve::before(double gamma, const ConstVectorRef& b_1, const ConstVectorRef& b_2, VectorRef r_q,
                             VectorRef dmu) const {
  dmu = H_.solve(b_1 + (G_.transpose() * r_q - b_2) / gamma);
  r_q -= gamma * (G_ * dmu);
}

void ConstraintSolve::after(double gamma, const ConstVectorRef& b_1, VectorRef dq, VectorRef dv,
                            VectorRef dlambda) const {
  const Vector scaled = S_.solve(G_.transpose() * dv - b_1);
  const Vector change = Y_ * scaled;
  dv -= change;
  dq -= gamma * change;
  dlambda = scaled / gamma;
}

std::size_t ConstraintSolve::bytes() const {
  return static_cast<std::size_t>(Y_.size() + 3 * Y_.cols() * Y_.cols()) * sizeof(double);
}

}  // namespace orthodyn::sundials
