#include "lib/analysis/prebuckling.h"

#include "lib/core/errors.h"

namespace orthodyn {

namespace {

constexpr double kStep = 1e-4;  // displacement step of the central difference, relative to the body's size

// Returns a A + b B.
MatrixValues sum(double a, const MatrixValues& A, double b, const MatrixValues& B) {
  MatrixValues out(A.size());
  for (std::size_t k = 0; k < A.size(); ++k) out[k] = a * A[k] + b * B[k];
  return out;
}

MatrixValues stiffness_at(const Model& model, double t, const Vector& q, TangentKind kind) {
  Linearization at;
  model.linearize(t, q, Vector::Zero(q.size()), kind, at);
  MatrixValues values(model.pattern().row.size());
  model.combine({0, 0, 1}, at, values.data());
  return values;
}

// Stress stiffness of the stresses at q: exact minus Gauss-Newton tangent.
MatrixValues stress_stiffness_at(const Model& structure, double t, const Vector& q) {
  return sum(1, stiffness_at(structure, t, q, TangentKind::exact), -1,
             stiffness_at(structure, t, q, TangentKind::gauss_newton));
}

// Stress stiffness of the linear response u about `unloaded`. The central difference cancels the second-order strains
// of a displacement along a straight line.
MatrixValues stress_stiffness(const Model& structure, double t, const Vector& unloaded, const Vector& u) {
  return sum(0.5, stress_stiffness_at(structure, t, unloaded + u), -0.5,
             stress_stiffness_at(structure, t, unloaded - u));
}

}  // namespace

MatrixValues small_load_stiffness(const FemModel& model, double t, const Vector& unloaded,
                                  const SmallResponse& response) {
  const auto structure = without_loads(model), loads = model.only(model.load_parts().value());
  return sum(1, stress_stiffness(*structure, t, unloaded, response.u), response.times,
             stiffness_at(*loads, t, unloaded, TangentKind::exact));
}

Prebuckling::Prebuckling(const FemModel& model, const Vector& unloaded, double t) {
  const Pattern& pattern = model.pattern();
  if (!pattern.symmetric)
    throw ConfigError("buckling needs a symmetric tangent; remove elasticity.warped_tangent: unsymmetric");
  stiffness_ = stiffness_at(*without_loads(model), t, unloaded, TangentKind::exact);
  solver_ = make_linear_solver("cholesky", pattern);
  if (solver_->factor(stiffness_.data()) != FactorStatus::ok)
    throw RunError("the stiffness without loads is not positive definite: the body is not held, or unstable");
  Vector f(unloaded.size()), u(unloaded.size());
  model.only(model.load_parts().value())->force(t, unloaded, Vector::Zero(unloaded.size()), f);
  if (f.isZero(0)) throw RunError("no load acts on the body, so it has no critical load factor");
  solver_->solve(f, u);
  // The central difference must be accurate for loads of any size.
  const double size = bounding_box(model.parts().mesh).size().maxCoeff();
  response_.times = kStep * size / u.lpNorm<Eigen::Infinity>();
  response_.u = response_.times * u;
}

}  // namespace orthodyn
