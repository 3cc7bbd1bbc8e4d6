#include "integrators/sundials/constraint_solve.h"

namespace orthodyn::sundials {

bool ConstraintSolve::factor(const ConstraintsAt::Solve& solve) {
  at_.emplace(constraints_, t_, q_, solve);
  const auto& G = at_->jacobian();
  H_.compute(Eigen::MatrixXd(G.transpose() * G));
  return at_->is_definite();
}

void ConstraintSolve::before(double gamma, const ConstVectorRef& b_1, const ConstVectorRef& b_2, VectorRef r_q,
                             VectorRef dmu) const {
  const auto& G = at_->jacobian();
  dmu = H_.solve(b_1 + (G.transpose() * r_q - b_2) / gamma);
  r_q -= gamma * (G * dmu);
}

void ConstraintSolve::after(double gamma, const ConstVectorRef& b_1, VectorRef dq, VectorRef dv,
                            VectorRef dlambda) const {
  const Vector scaled = at_->solve(dv, b_1);
  const Vector change = at_->change(scaled);
  dv -= change;
  dq -= gamma * change;
  dlambda = scaled / gamma;
}

}  // namespace orthodyn::sundials
