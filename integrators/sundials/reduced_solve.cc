#include "integrators/sundials/reduced_solve.h"

#include "lib/core/errors.h"

namespace orthodyn::sundials {

namespace {
constexpr int kGaussNewtonSetups = 10;
}

ReducedSolve::ReducedSolve(const Model& model, const std::string& solver, TangentKind tangent,
                           Statistics& statistics)
    : model_(model), statistics_(statistics), tangent_(tangent), work_(model.num_dofs()) {
  const auto& kind = solver_registry().at(solver);
  if (!model.pattern().symmetric && !kind.takes_general)
    throw ConfigError("linear solver '" + solver + "' needs a symmetric tangent; use klu or klu_full, or " +
                      "elasticity.warped_tangent: rotated");
  solver_ = kind.make();
  solver_->analyze(model.pattern());
  values_.resize(model.pattern().row.size());
}

std::size_t ReducedSolve::bytes() const {
  const auto matrices = model_.traits().damping_matrix ? 3u : 2u;  // K, A and perhaps D
  return (matrices * values_.size() + 3 * static_cast<std::size_t>(work_.size())) * sizeof(double);
}

void ReducedSolve::linearize(double t, const ConstVectorRef& q, const ConstVectorRef& v) {
  at_.t = t;
  at_.q = q;
  at_.v = v;
  assemble(gauss_newton_left_ > 0 ? TangentKind::gauss_newton : tangent_);
  if (gauss_newton_left_ > 0) --gauss_newton_left_;
}

void ReducedSolve::assemble(TangentKind kind) {
  const Measure measure(statistics_.tangent);
  model_.linearize(at_.t, at_.q, at_.v, kind, linearization_);
}

FactorStatus ReducedSolve::try_factor(double gamma) {
  const Measure measure(statistics_.factorization);
  gamma_ = gamma;
  model_.combine({1, gamma, gamma * gamma}, linearization_, values_.data());
  return solver_->factor(values_.data());
}

bool ReducedSolve::factor(double gamma) {
  auto status = try_factor(gamma);
  if (status == FactorStatus::not_positive_definite && !model_.traits().linear) {
    ++statistics_.gauss_newton_fallbacks;
    gauss_newton_left_ = kGaussNewtonSetups;
    assemble(TangentKind::gauss_newton);
    status = try_factor(gamma);
  }
  return status == FactorStatus::ok;
}

void ReducedSolve::solve(const ConstVectorRef& r_q, const ConstVectorRef& p, VectorRef dq, VectorRef dv) {
  const Measure measure(statistics_.solve);
  model_.pattern().multiply(linearization_.stiffness.data(), r_q, work_);
  work_ = p - gamma_ * work_;
  solver_->solve(work_, dv);
  dq = r_q + gamma_ * dv;
}

}  // namespace orthodyn::sundials
