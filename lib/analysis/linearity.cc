#include "lib/analysis/linearity.h"

#include <cmath>
#include <limits>

namespace orthodyn {

namespace {
constexpr double kNegligible = 1e-6;  // an error of nobody's interest, and above round-off
double norm(const Vector& x, const Vector& Mx) { return std::sqrt(std::max(x.dot(Mx), 0.0)); }
}  // namespace

Linearity::Linearity(const FemModel& linear, const FemModel& exact, double span) : linear_(linear), exact_(exact) {
  const Vector zero = Vector::Zero(linear.num_dofs());
  Linearization at;
  linear.linearize(0, zero, zero, TangentKind::exact, at);
  values_.resize(at.stiffness.size());
  linear.combine({std::isfinite(span) ? 1 / (span * span) : 0, 0, 1}, at, values_.data());
  solver_ = solver_registry().at(linear.pattern().symmetric ? "cholmod" : "klu").make();
  solver_->analyze(linear.pattern());
  if (solver_->factor(values_.data()) != FactorStatus::ok)
    throw RunError("the stiffness at rest is singular: the body is not held");
}

LinearityError Linearity::error(double t, const Vector& q) const {
  constexpr double kAccuracy = 0.02;  // of the error itself
  constexpr double kSlowest = 0.7;    // contraction of the energy of steps
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  const Vector still = Vector::Zero(q.size());
  Vector of_linear(q.size()), of_exact(q.size()), step(q.size()), Mq(q.size()), Mx(q.size());
  linear_.multiply_mass(q, Mq);
  const double square = q.dot(Mq);
  if (!(square > 0)) return {};
  linear_.force(t, q, still, of_linear);
  Vector x = still;
  for (double before = kInfinity;;) {
    try {
      exact_.force(t, q + x, still, of_exact);
    } catch (const RecoverableError&) {
      return {kInfinity, kInfinity};
    }
    const Vector residual = of_exact - of_linear;
    solver_->solve(residual, step);
    x += step;
    const double energy = step.dot(residual);
    linear_.multiply_mass(step, Mx);
    const double last = norm(step, Mx);
    linear_.multiply_mass(x, Mx);
    const double all = norm(x, Mx);
    if (last <= kAccuracy * all || std::max(last, all) <= kNegligible * std::sqrt(square))
      return {all / std::sqrt(square), std::abs(x.dot(Mq)) / square};
    if (!(energy < kSlowest * before)) return {kInfinity, kInfinity};  // would take long, or has no end
    before = energy;
  }
}

}  // namespace orthodyn
