#include "integrators/native/one_step.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "integrators/run_checks.h"
#include "lib/ode/constraints_at.h"

namespace orthodyn {

namespace {
constexpr int kMostAttempts = 20, kMostHalvings = 10;
// kAfterNewton: factor for the step after a failure of Newton's method or of the force. kRelease: factor by which the
// limit set then grows with each accepted step.
constexpr double kAfterNewton = 0.5, kRelease = 1.05;
}  // namespace

OneStep::OneStep(std::string name, const Model& model, const LinearOptions& options, const Scales& scales)
    : model_(model),
      norm_(options.rtol, scales, model.space()),
      name_(std::move(name)),
      options_(options),
      scales_(scales),
      control_(1),
      e_q_(model.num_dofs()),
      e_v_(model.num_dofs()) {
  const Vector zero = Vector::Zero(model.num_dofs());
  before_ = now_ = next_ = {0, zero, zero, zero};
}

void OneStep::force(double t, const ConstVectorRef& q, const ConstVectorRef& v, VectorRef f) {
  const Measure measure(statistics_.force);
  model_.force(t, q, v, f);
  require_finite(model_, f);
}

void OneStep::start(const State& state) {
  now_.t = state.t;
  now_.q = state.q;
  now_.v = state.v;
  if (model_.constraints()) {
    ConstraintsAt(model_, now_.t, now_.q).fit_positions(now_.q);
    ConstraintsAt(model_, now_.t, now_.q).fit(now_.v);
  }
  try {
    accelerate(now_);
  } catch (const RecoverableError& e) {
    throw initial_force_error(name_, now_.t, e.what());
  }
  before_ = now_;
  control_ = PredictiveStepController(orders().estimate);
  h_ = options_.h0.value_or(0);
  newton_limit_ = std::numeric_limits<double>::infinity();
  restarted();
}

void OneStep::accelerate(StepEnd& at) {
  at.a.resize(at.q.size());
  force(at.t, at.q, at.v, at.a);
  model_.solve_mass(at.a);
  if (model_.constraints()) at.lambda = ConstraintsAt(model_, at.t, at.q).multipliers(at.v, at.a);
}

StepInfo OneStep::step(double t_stop) {
  if (statistics_.steps >= options_.max_steps)
    throw too_many_steps_error(name_, now_.t, statistics_.steps, options_.step ? "integrator.step" : "integrator.rtol");
  if (options_.step) advance_by_fixed_step(t_stop);
  else advance_adaptively(t_stop);
  ++statistics_.steps;
  return {now_.t, now_.t - before_.t, orders().method};
}

void OneStep::interpolate(double t, State& out) const {
  out.t = t;
  out.q.resize(now_.q.size());
  out.v.resize(now_.v.size());
  if (before_.t == now_.t) {  // no step yet
    out.q = now_.q;
    out.v = now_.v;
    out.lambda = now_.lambda;
    return;
  }
  if (model_.constraints()) {
    const double s = (t - before_.t) / (now_.t - before_.t);
    out.lambda = (1 - s) * before_.lambda + s * now_.lambda;
  }
  // Positions and velocities of a method of order 1 fit no common polynomial: the velocity of the polynomial would
  // oscillate.
  if (orders().method == 1) interpolate_linearly(before_, now_, t, out.q, out.v);
  else orthodyn::interpolate(before_, now_, t, out.q, out.v);
}

std::optional<State> OneStep::mean_state() const {
  if (!balances_by_mean_velocity() || before_.t == now_.t) return std::nullopt;
  return orthodyn::mean_state(before_, now_);
}

void OneStep::accept(double h) {
  accepted(h);
  std::swap(before_, now_);
  std::swap(now_, next_);
}

OneStep::StepResult OneStep::try_step(double h) {
  cause_.clear();
  try {
    if (!attempt(h)) return StepResult::newton;
    if (options_.step) return StepResult::good;
    estimate(h, e_q_, e_v_);
    error_ = norm_(e_q_, e_v_);
    return error_ <= 1 ? StepResult::good : StepResult::error_test;
  } catch (const RecoverableError& e) {
    cause_.note(e);
    return StepResult::force;
  }
}

void OneStep::count(StepResult result) {
  if (result == StepResult::good) return;
  ++statistics_.rejected_steps;
  ++(result == StepResult::error_test ? statistics_.error_test_failures : statistics_.convergence_failures);
}

double OneStep::resolution() const { return 4 * std::numeric_limits<double>::epsilon() * std::abs(now_.t); }

void OneStep::advance_adaptively(double t_stop) {
  if (h_ == 0) h_ = first_step(t_stop);
  const double planned = h_;
  bool refused = false;
  for (int attempts = 0;; ++attempts) {
    const double h = length(t_stop);
    next_.t = h == t_stop - now_.t ? t_stop : now_.t + h;
    const StepResult result = try_step(h);
    count(result);
    if (result == StepResult::good) {
      accept(h);
      const double factor = std::min(control_.after_success(h, error_), largest_growth());
      h_ = h * (refused ? std::min(factor, 1.0) : factor);
      if (!refused && h < planned) h_ = std::max(h_, planned);  // shortened only by t_stop or h_max
      newton_limit_ *= kRelease;
      h_ = std::min(h_, newton_limit_);
      return;
    }
    refused = true;
    if (result == StepResult::error_test && std::isfinite(error_)) h_ = h * control_.after_failure(error_);
    else h_ = newton_limit_ = kAfterNewton * h;
    if (attempts == kMostAttempts || h_ <= resolution() || h_ < options_.h_min) give_up(result, now_.t, h);
  }
}

double OneStep::length(double t_stop) const {
  double h = std::max(h_, options_.h_min);
  if (options_.h_max) h = std::min(h, *options_.h_max);
  return length_of_step(h, t_stop - now_.t);
}

// First step (s) by the norms of the first and second derivatives (Hairer, Norsett & Wanner 1993, II.4). The unit of
// time is the probe interval h, so that the result does not depend on the scene's unit. h is not a round fraction of
// the time left, because a periodic load might have the same value after a round fraction.
double OneStep::first_step(double t_stop) {
  constexpr double kProbe = 0.00618034;
  const double rest = t_stop - now_.t;
  const double rate = norm_(now_.v, now_.a);
  double h = kProbe * rest;
  if (rate > 0) h = std::min(h, 0.01 / (options_.rtol * rate));
  double curvature = 0;
  try {
    StepEnd probe{now_.t + h, now_.q + h * now_.v, now_.v + h * now_.a, {}};
    accelerate(probe);
    curvature = norm_(h * now_.a, probe.a - now_.a) / h;
  } catch (const RecoverableError&) {
    h *= 1e-2;
  }
  const double largest = std::max(rate, h * curvature) * h;
  if (largest <= 0) return h;
  return std::min({rest, 100 * h, h * std::pow(0.01 / largest, 1.0 / orders().estimate)});
}

void OneStep::advance_by_fixed_step(double t_stop) {
  const double h = length_of_fixed_step(*options_.step, t_stop - now_.t);
  const double t_end = h == t_stop - now_.t ? t_stop : now_.t + h;
  next_.t = t_end;
  StepResult result = try_step(h);
  count(result);
  if (result == StepResult::good) return accept(h);

  const StepEnd begin = now_;
  const double least = h * std::ldexp(1, -kMostHalvings);
  for (double part = h / 2; now_.t < t_end;) {
    if (part < least) give_up(result, begin.t, h);
    const double rest = t_end - now_.t, tried = length_of_fixed_step(part, rest);
    next_.t = tried == rest ? t_end : now_.t + tried;
    result = try_step(tried);
    count(result);
    if (result == StepResult::good) accept(tried);
    else part = tried / 2;
  }
  before_ = begin;
}

void OneStep::give_up(StepResult result, double t, double h) const {
  const std::string where = fmt::format("{} stopped at t = {:.6g} s, step {:.3g} s: ", name_, t, h);
  const std::string shorter = options_.step ? "lower integrator.step" : "lower integrator.h_max or rtol";
  switch (result) {
    case StepResult::force:
      throw RunError(where + cause_.explain("the force cannot be evaluated", "; " + shorter + " or check the loads"),
                     Reason::force);
    case StepResult::newton:
      throw RunError(where + "Newton's method does not converge" +
                         (options_.step ? fmt::format(" in {} halvings of the step", kMostHalvings) : "") + "; " +
                         shorter + ", set integrator.gauss_newton: true, or check for inverted elements",
                     Reason::newton);
    default:
      throw RunError(where +
                         "the error test keeps failing; raise integrator.rtol, lower integrator.h_min, or look for a "
                         "kink in the loads",
                     Reason::error_test);
  }
}

std::size_t OneStep::bytes() const {
  return method_bytes() + 11 * static_cast<std::size_t>(model_.num_dofs()) * sizeof(double);
}

Decisions OneStep::decisions() const {
  auto all = scale_decisions(scales_);
  all.emplace_back("linear_solver", shown(options_.linear_solver) + " (" + solver_description() + ")");
  return all;
}

}  // namespace orthodyn
