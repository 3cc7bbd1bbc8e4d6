#include "integrators/native/stage_solver.h"

#include <cmath>

#include "integrators/run_checks.h"
#include "lib/core/errors.h"

namespace orthodyn {

namespace {
// Relative change of w_k up to which the factor is kept and corrections are scaled.
constexpr double kWeightDrift = 0.25;
constexpr double kSameWeight = 1e-12;  // relative difference between equal steps by round-off
constexpr double kLinearShare = 0.05;  // tolerance of an iterative linear solver / Newton's tolerance
// Relative to the scales: smaller corrections that do not shrink are round-off.
constexpr double kCorrectionRoundOff = 1e-10;
}  // namespace

StageSolver::StageSolver(const Model& model, const NewtonOptions& options, const ScaledNorm& norm,
                         Statistics& statistics)
    : model_(model),
      linear_(model.traits().linear && !model.constraints()),
      kind_(options.newton),
      exhaustive_(options.step.has_value()),
      tolerance_(options.nonlinear_coefficient),
      max_iterations_(options.max_newton_iterations),
      norm_(norm),
      statistics_(statistics),
      matrix_(model, options.linear_solver, options.tangent(), statistics),
      renewal_(renewal_cost(model)),
      remaining_(linear_),
      r_(model.num_dofs()),
      dx_(model.num_dofs()),
      guess_(model.num_dofs()),
      work_(model.num_dofs()),
      constraints_(model.constraints()) {
  matrix_.set_newton_tolerance(0);
  if (constraints_) lambda_ = g_ = Vector::Zero(constraints_->size());
}

void StageSolver::begin_step() {
  if (kind_ != NewtonKind::lazy) stale_ = true;
}

bool StageSolver::solve(const Stage& stage, VectorRef x, VectorRef q, VectorRef v) {
  if (!stale_ && kind_ == NewtonKind::lazy && !linear_) stale_ = renewal_.is_due();
  const long iterations = statistics_.newton_iterations, tangents = statistics_.tangent.count;
  const auto note = [&] {
    renewal_.note(static_cast<double>(statistics_.newton_iterations - iterations),
                  statistics_.tangent.count > tangents);
  };
  try {
    const bool solved = try_solve(stage, x, q, v);
    note();
    return solved;
  } catch (...) {
    note();
    throw;
  }
}

bool StageSolver::try_solve(const Stage& stage, VectorRef x, VectorRef q, VectorRef v) {
  guess_ = x;
  lambda_guess_ = lambda_;
  const auto restart = [&] {
    x = guess_;
    lambda_ = lambda_guess_;
  };
  const bool renew = stale_ || kind_ == NewtonKind::full;
  if (!prepare(stage, x, renew)) return false;
  const bool each_time = kind_ == NewtonKind::full;
  if (iterate(stage, x, q, v, each_time)) return true;
  const bool nothing_to_renew = (renew || linear_) && drift(stage) == 0;
  if (!nothing_to_renew) {
    restart();
    if (prepare(stage, x, true) && iterate(stage, x, q, v, each_time)) return true;
  }
  if (!exhaustive_ || each_time || linear_) return false;
  restart();
  return prepare(stage, x, true) && iterate(stage, x, q, v, true);
}

// Relative difference of w_k between the factor and the stage.
double StageSolver::drift(const Stage& stage) const {
  const double drift = std::abs(stage.w_k / matrix_.weights().stiffness - 1);
  return drift < kSameWeight ? 0 : drift;
}

bool StageSolver::prepare(const Stage& stage, const ConstVectorRef& x, bool renew) {
  if (renew) linearize(stage, x);
  if (factored_ && drift(stage) <= (renew ? 0 : kWeightDrift)) {
    if (drift(stage) > 0) remaining_.restart();
    return true;
  }
  remaining_.restart();
  factored_ = matrix_.factor({1, stage.w_d, stage.w_k});
  if (factored_ && constraints_) {
    constraints_at_.emplace(*constraints_, t_, q_,
                            [this](const Vector& b, Vector& solution) { matrix_.solve(b, solution); });
    factored_ = constraints_at_->is_definite();
  }
  return factored_;
}

void StageSolver::linearize(const Stage& stage, const ConstVectorRef& x) {
  stale_ = false;
  if (linearized_ && linear_) return;
  t_ = stage.t;
  q_ = stage.q + stage.w_k * x;
  matrix_.linearize(t_, q_, stage.v + stage.w_d * x);
  linearized_ = true;
  factored_ = false;
}

bool StageSolver::iterate(const Stage& stage, VectorRef x, VectorRef q, VectorRef v, bool renew_each_time) {
  remaining_.begin();
  double last = 0;
  for (int k = 1; k <= max_iterations_; ++k) {
    q = stage.q + stage.w_k * x;
    v = stage.v + stage.w_d * x;
    if (k > 1 && renew_each_time && !prepare(stage, x, true)) return false;
    correction(stage, x, q, v);
    x += dx_;
    const double size = norm_(dx_, stage.w_k, stage.w_d);
    if (!std::isfinite(size)) return false;
    const double ratio = last > 0 ? size / last : 0;
    const bool is_round_off = ratio >= 1 && size * norm_.rtol() <= kCorrectionRoundOff;
    if (ratio >= 1 && !is_round_off) return false;
    if (last > 0 && !is_round_off) remaining_.note(ratio);
    if (is_round_off || remaining_.after(size, matrix_.least_rate()) <= tolerance_) {
      q += stage.w_k * dx_;
      v += stage.w_d * dx_;
      return true;
    }
    last = size;
  }
  stale_ = true;
  return false;
}

void StageSolver::correction(const Stage& stage, const ConstVectorRef& x, const ConstVectorRef& q,
                             const ConstVectorRef& v) {
  {
    const Measure measure(statistics_.force);
    model_.force(stage.t, q, v, r_);
  }
  require_finite(model_, r_);
  model_.multiply_mass(x, work_);
  r_ -= work_;
  if (constraints_) r_ -= constraints_->jacobian(stage.t, q) * lambda_;
  matrix_.set_newton_tolerance(norm_.root_mean_square_at(kLinearShare * tolerance_, stage.w_k, stage.w_d));
  matrix_.solve(r_, dx_);
  // Scales the correction for outdated weights, as CVODE does for an outdated gamma.
  const double scale = 2 / (1 + stage.w_k / matrix_.weights().stiffness);
  dx_ *= scale;
  if (constraints_) correct_multipliers(stage, q, scale);
  ++statistics_.newton_iterations;
}

void StageSolver::correct_multipliers(const Stage& stage, const ConstVectorRef& q, double scale) {
  constraints_->values(stage.t, q, g_);
  const Vector change = constraints_at_->solve(dx_, -g_ / stage.w_k);
  dx_ -= constraints_at_->change(change);
  lambda_ += change / scale;
}

Vector StageSolver::violation(double t, const ConstVectorRef& q, const ConstVectorRef& v) {
  if (!factored_) return Vector::Zero(q.size());
  constraints_->rates(t, q, v, g_);
  return constraints_at_->least_change(g_);
}

void StageSolver::filter(VectorRef e_q, VectorRef e_v) {
  const Weights& w = matrix_.weights();
  matrix_.multiply_stiffness(e_q, work_);
  model_.multiply_mass(e_v, r_);
  r_ -= w.stiffness / w.damping * work_;
  matrix_.set_newton_tolerance(norm_.root_mean_square_at(kLinearShare, w.damping, 1));
  matrix_.solve(r_, dx_);
  if (constraints_) constraints_at_->remove_violation(dx_);
  e_v = dx_;
  e_q += w.damping * dx_;
  if (constraints_) constraints_at_->remove_violation(e_q);
}

}  // namespace orthodyn
