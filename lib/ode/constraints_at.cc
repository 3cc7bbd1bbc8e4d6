#include "lib/ode/constraints_at.h"

#include "lib/ode/model.h"

namespace orthodyn {

ConstraintsAt::ConstraintsAt(const Model& model, double t, const Vector& q)
    : constraints_(*model.constraints()), t_(t), q_(q), G_(constraints_.jacobian(t, q)), W_(G_) {
  for (Eigen::Index k = 0; k < W_.cols(); ++k) model.solve_mass(W_.col(k));
  H_ = G_.transpose() * W_;
  factor_.compute(H_);
}

void ConstraintsAt::fit_positions(VectorRef q) const {
  constexpr int kMost = 3;  // of Newton's method with one Jacobian, from positions within an integrator's tolerance
  Vector g(G_.cols());
  for (int k = 0; k < kMost; ++k) {
    constraints_.values(t_, q, g);
    q -= W_ * factor_.solve(g);
  }
}

void ConstraintsAt::fit(VectorRef v) const {
  Vector rates(G_.cols());
  constraints_.rates(t_, q_, v, rates);
  v -= W_ * factor_.solve(rates);
}

Vector ConstraintsAt::multipliers(const ConstVectorRef& v, VectorRef a) const {
  Vector curvature(G_.cols());
  constraints_.curvature(t_, q_, v, curvature);
  const Vector lambda = factor_.solve(G_.transpose() * a + curvature);
  a -= W_ * lambda;
  return lambda;
}

}  // namespace orthodyn
