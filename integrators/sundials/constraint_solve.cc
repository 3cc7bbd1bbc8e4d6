#include "integrators/sundials/constraint_solve.h"

namespace orthodyn::sundials {

void ConstraintSolve::linearize(double t, const ConstVectorRef& q) {
  complement_.linearize(t, q);
  const auto& G = complement_.jacobian();
  H_.compute(Eigen::MatrixXd(G.transpose() * G));
}

void ConstraintSolve::before(double gamma, const ConstVectorRef& b_1, const ConstVectorRef& b_2, VectorRef r_q,
                             VectorRef dmu) const {
  const auto& G = complement_.jacobian();
  dmu = H_.solve(b_1 + (G.transpose() * r_q - b_2) / gamma);
  r_q -= gamma * (G * dmu);
}

void ConstraintSolve::after(double gamma, const ConstVectorRef& b_1, VectorRef dq, VectorRef dv,
                            VectorRef dlambda) const {
  const Vector scaled = complement_.multipliers(dv, b_1);
  const Vector change = complement_.change(scaled);
  dv -= change;
  dq -= gamma * change;
  dlambda = scaled / gamma;
}

std::size_t ConstraintSolve::bytes() const {
  return complement_.bytes() + static_cast<std::size_t>(H_.rows() * H_.cols()) * sizeof(double);
}

}  // namespace orthodyn::sundials
