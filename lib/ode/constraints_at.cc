#include "lib/ode/constraints_at.h"

#include "lib/ode/model.h"

namespace orthodyn {

ConstraintsAt::ConstraintsAt(const Constraints& constraints, double t, const Vector& q, const Solve& solve)
    : constraints_(constraints), t_(t), q_(q), G_(constraints.jacobian(t, q)), W_(G_.rows(), G_.cols()) {
  Vector x(G_.rows());
  for (Eigen::Index k = 0; k < G_.cols(); ++k) {
    solve(Vector(G_.col(k)), x);
    W_.col(k) = x;
  }
  S_ = G_.transpose() * W_;
  factor_.compute(S_);
}

ConstraintsAt::ConstraintsAt(const Model& model, double t, const Vector& q)
    : ConstraintsAt(*model.constraints(), t, q, [&](const Vector& b, Vector& x) {
        x = b;
        model.solve_mass(x);
      }) {}

void ConstraintsAt::fit_positions(VectorRef q) const {
  constexpr int kMost = 3;  // of Newton's method with one Jacobian, from positions within an integrator's tolerance
  Vector g(G_.cols());
  for (int k = 0; k < kMost; ++k) {
    constraints_.values(t_, q, g);
    q -= least_change(g);
  }
}

void ConstraintsAt::fit(VectorRef v) const {
  Vector rates(G_.cols());
  constraints_.rates(t_, q_, v, rates);
  v -= least_change(rates);
}

Vector ConstraintsAt::multipliers(const ConstVectorRef& v, VectorRef a) const {
  Vector curvature(G_.cols());
  constraints_.curvature(t_, q_, v, curvature);
  const Vector lambda = solve(a, -curvature);
  a -= change(lambda);
  return lambda;
}

std::size_t ConstraintsAt::bytes() const {
  return static_cast<std::size_t>(W_.size() + 2 * S_.size()) * sizeof(double);
}

}  // namespace orthodyn
