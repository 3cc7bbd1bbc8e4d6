#include "integrators/newton_matrix.h"

#include "lib/core/errors.h"

namespace orthodyn {

namespace {
constexpr int kGaussNewtonSetups = 10;
}

NewtonMatrix::NewtonMatrix(const Model& model, const SolverChoice& solver, TangentKind tangent, Statistics& statistics)
    : model_(model),
      statistics_(statistics),
      tangent_(tangent),
      needs_exact_solutions_(model.traits().linear || model.traits().free) {
  const auto& kind = solver_registry().at(solver.type);
  if (!model.pattern().symmetric && !kind.takes_general)
    throw ConfigError("linear solver '" + solver.type + "' needs a symmetric tangent; use klu or klu_full, or " +
                      "elasticity.warped_tangent: rotated");
  solver_ = make_linear_solver(solver, model.pattern());
  values_.resize(model.pattern().row.size());
}

std::size_t NewtonMatrix::bytes() const {
  const auto matrices = model_.traits().damping_matrix ? 3u : 2u;  // K, A and perhaps D
  return (matrices * values_.size() + 2 * static_cast<std::size_t>(model_.num_dofs())) * sizeof(double);
}

void NewtonMatrix::linearize(double t, const ConstVectorRef& q, const ConstVectorRef& v) {
  at_.t = t;
  at_.q = q;
  at_.v = v;
  assemble(gauss_newton_left_ > 0 ? TangentKind::gauss_newton : tangent_);
  if (gauss_newton_left_ > 0) --gauss_newton_left_;
}

void NewtonMatrix::assemble(TangentKind kind) {
  const Measure measure(statistics_.tangent);
  model_.linearize(at_.t, at_.q, at_.v, kind, linearization_);
}

FactorStatus NewtonMatrix::try_factor() {
  const Measure measure(statistics_.factorization);
  model_.combine(weights_, linearization_, values_.data());
  if (solver_->wants_rigid_motions()) solver_->set_rigid_motions(model_.rigid_motions(at_.q));
  return solver_->factor(values_.data());
}

bool NewtonMatrix::factor(const Weights& weights) {
  weights_ = weights;
  auto status = try_factor();
  if (status == FactorStatus::not_positive_definite && !model_.traits().linear) {
    turn_to_gauss_newton();
    assemble(TangentKind::gauss_newton);
    status = try_factor();
  }
  return status == FactorStatus::ok;
}

void NewtonMatrix::turn_to_gauss_newton() {
  ++statistics_.gauss_newton_fallbacks;
  gauss_newton_left_ = kGaussNewtonSetups;
}

void NewtonMatrix::solve(const ConstVectorRef& b, VectorRef x) {
  const Measure measure(statistics_.solve);
  try {
    solver_->solve(b, x);
  } catch (const IndefiniteMatrix&) {
    if (!model_.traits().linear) turn_to_gauss_newton();
    throw;
  }
}

void NewtonMatrix::multiply_stiffness(const ConstVectorRef& x, VectorRef y) const {
  model_.multiply_matrix(linearization_.stiffness.data(), x, y);
}

}  // namespace orthodyn
