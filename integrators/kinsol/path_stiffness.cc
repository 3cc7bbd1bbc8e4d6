#include "integrators/kinsol/path_stiffness.h"

#include <algorithm>

#include "lib/core/errors.h"

namespace orthodyn {

namespace {
// Relative tolerance of an iterative solver. Newton's method removes the remaining error. Near a critical point a
// smaller tolerance is not reached.
constexpr double kTolerance = 1e-6;
}  // namespace

PathStiffness::PathStiffness(const Model& model, const SolverChoice& solver, Statistics& statistics)
    : model_(model), statistics_(statistics) {
  const auto& kind = solver_registry().at(solver.type);
  if (!model.pattern().symmetric && !kind.takes_general)
    throw ConfigError("linear solver '" + solver.type + "' needs a symmetric tangent; use klu, or " +
                      "elasticity.warped_tangent: rotated");
  solver_ = make_linear_solver(solver, model.pattern());
  solver_->set_tolerance({.relative = kTolerance});
  values_.resize(model.pattern().row.size());
}

void PathStiffness::linearize(double lambda, const ConstVectorRef& q, TangentKind kind) {
  const Measure measure(statistics_.tangent);
  q_ = q;
  model_.linearize(lambda, q, Vector::Zero(q.size()), kind, linearization_);
}

void PathStiffness::linearize_predicted(double lambda_before, const ConstVectorRef& q_before, double lambda,
                                        const ConstVectorRef& q) {
  const Measure measure(statistics_.tangent);
  q_ = q;
  model_.linearize_predicted(lambda_before, q_before, lambda, q, linearization_);
}

bool PathStiffness::factor() {
  if (constant_is_factored_) return true;
  const Measure measure(statistics_.factorization);
  model_.combine({0, 0, 1}, linearization_, values_.data());
  // If the last K was indefinite, this one probably is, too.
  const bool done = !model_.pattern().symmetric                      ? factor_general()
                    : negative_.value_or(0) > 0 || iteration_failed_ ? factor_indefinite()
                                                                     : factor_definite();
  constant_is_factored_ = done && model_.traits().linear;
  return done;
}

bool PathStiffness::factor_with_inertia() {
  if (!model_.pattern().symmetric) return factor();
  if (solver_->checks_definiteness() || solver_->is_iterative()) return factor();
  const Measure measure(statistics_.factorization);
  model_.combine({0, 0, 1}, linearization_, values_.data());
  constant_is_factored_ = false;
  return factor_indefinite();
}

bool PathStiffness::factor_general() {
  used_ = solver_.get();
  const bool regular = solver_->factor(values_.data()) == FactorStatus::ok;
  negative_.reset();
  if (const auto odd = regular ? solver_->has_negative_determinant() : std::nullopt) negative_ = *odd ? 1 : 0;
  return regular;
}

bool PathStiffness::factor_definite() {
  used_ = solver_.get();
  if (solver_->wants_rigid_motions()) solver_->set_rigid_motions(model_.rigid_motions(q_));
  const FactorStatus status = solver_->factor(values_.data());
  if (status == FactorStatus::not_positive_definite) return factor_indefinite();
  negative_ = solver_->checks_definiteness() ? std::optional<int>(0) : std::nullopt;
  return status == FactorStatus::ok;
}

bool PathStiffness::factor_indefinite() {
  if (!indefinite_) indefinite_ = make_indefinite_solver(model_.pattern());
  used_ = indefinite_.get();
  const bool regular = indefinite_->factor(values_.data()) == FactorStatus::ok;
  negative_ = indefinite_->negative_eigenvalues();
  return regular;
}

void PathStiffness::solve(const ConstVectorRef& b, VectorRef x) {
  try {
    const Measure measure(statistics_.solve);
    return used_->solve(b, x);
  } catch (const RecoverableError&) {  // an iterative solver finds K indefinite, or does not converge
    const Measure measure(statistics_.factorization);
    constant_is_factored_ = false;
    if (!factor_indefinite()) throw;
    iteration_failed_ = negative_ == 0;
  }
  const Measure measure(statistics_.solve);
  used_->solve(b, x);
}

std::string PathStiffness::description() const {
  const char* const instead = iteration_failed_ ? ", L D L^T where it did not converge"
                              : indefinite_     ? ", L D L^T where the stiffness is indefinite"
                                                : "";
  return solver_->description() + instead;
}

std::size_t PathStiffness::factor_bytes() const {
  return std::max(solver_->factor_bytes(), indefinite_ ? indefinite_->factor_bytes() : 0);
}

}  // namespace orthodyn
