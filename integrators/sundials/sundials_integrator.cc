#include "integrators/sundials/sundials_integrator.h"

#include <fmt/format.h>

#include <cmath>
#include <limits>

#include "integrators/finite_force.h"
#include "integrators/scaled_norm.h"

namespace orthodyn::sundials {

SundialsIntegrator::SundialsIntegrator(std::string name, const Model& model, const Settings& settings)
    : model_(model),
      settings_(settings),
      y_(make_vector(size(), context_, model.ranks())),
      momentum_(model.num_dofs()),
      name_(std::move(name)) {
  if (!settings.implicit) return;
  if (!model.traits().smooth && settings.options.max_newton_iterations < 2)
    throw ConfigError("max_newton_iterations: must be at least 2 if the body may touch something, found 1");
  if (settings.full) full_.emplace(model);
  else reduced_.emplace(model, settings.options.linear_solver, settings.options.tangent(), statistics_);
}

void SundialsIntegrator::start(const State& state) {
  positions(y()) = state.q;
  velocities(y()) = state.v;
  t_ = state.t;
  if (started_) {
    const Counters now = counters();
    reinitialise(state.t);  // sets the library's counters to zero
    before_.steps += now.steps;
    before_.error_test_failures += now.error_test_failures;
    before_.convergence_failures += now.convergence_failures;
    before_.newton_iterations += now.newton_iterations;
  } else {
    initialise(state.t);
    started_ = true;
  }
}

StepInfo SundialsIntegrator::step(double t_stop) {
  if (statistics_.steps >= settings_.options.max_steps)
    throw RunError(fmt::format("{} gave up at t = {:.6g} s after {} steps (max_steps); raise integrator.max_steps "
                               "or integrator.{}",
                               name_, t_, statistics_.steps, adaptive() ? "rtol" : "step"),
                   Reason::too_many_steps);
  callback_context_ = {};
  const int flag = advance(t_stop, t_);
  update_statistics();
  if (flag < 0) fail(flag);
  StepInfo info = last_step();
  info.t = t_;
  refuse_tiny_steps(info, t_stop);
  return info;
}

// In front of a time past which the model cannot be evaluated the library takes ever smaller steps.
void SundialsIntegrator::refuse_tiny_steps(const StepInfo& info, double t_stop) const {
  if (info.t >= t_stop || info.h > 4 * std::numeric_limits<double>::epsilon() * std::abs(info.t)) return;
  throw RunError(position() + "the step has shrunk to the resolution of time" + cause() +
                     "; raise integrator.rtol, lower integrator.h_max or check the loads",
                 Reason::step_too_small);
}

std::string SundialsIntegrator::position() const {
  return fmt::format("{} stopped at t = {:.6g} s, step {:.3g} s: ", name_, t_, current_step());
}

std::string SundialsIntegrator::cause() const {
  return callback_context_.recoverable_cause.empty() ? "" : " (" + callback_context_.recoverable_cause + ")";
}

void SundialsIntegrator::interpolate(double t, State& out) const {
  const auto dense = make_vector(size(), context_, model_.ranks());
  if (dense_output(t, dense.get()) < 0)
    throw RunError(fmt::format("{} cannot interpolate at t = {:.17g} s: {}", name_, t, callback_context_.message));
  out.t = t;
  out.q = positions(dense.get());
  out.v = velocities(dense.get());
}

std::size_t SundialsIntegrator::bytes() const { return workspace_bytes() + (reduced_ ? reduced_->bytes() : 0); }

Decisions SundialsIntegrator::decisions() const {
  auto all = settings_.decisions;
  if (!settings_.implicit) return all;
  const std::string detail = reduced_ ? " (" + reduced_->description() + ")" : "";
  all.emplace_back("linear_solver", shown(settings_.options.linear_solver) + detail);
  return all;
}

void SundialsIntegrator::require(int flag) const {
  if (flag < 0) throw RunError(name_ + " refused its set-up: " + callback_context_.message);
}

void SundialsIntegrator::make_reduced_solver(std::function<double()> gamma,
                                             std::function<void(N_Vector, N_Vector)> solve) {
  matrix_ = make_placeholder_matrix(context_);
  functions_.setup = [this, gamma = std::move(gamma)] {
    bool factored = false;
    const int thrown = guarded(callback_context_, [&] { factored = reduced_->factor(gamma()); });
    return thrown ? thrown : factored ? 0 : 1;
  };
  functions_.iterative = reduced_->is_iterative();
  functions_.solve = [this, solve = std::move(solve)](N_Vector x, N_Vector b, double tolerance) {
    const ScaledNorm norm(settings_.options.rtol, settings_.scales);
    reduced_->set_newton_tolerance(norm.root_mean_square_at(tolerance, reduced_->gamma(), 1));
    return guarded(callback_context_, [&] { solve(x, b); });
  };
  solver_ = make_solver_adapter(functions_, context_);
}

void SundialsIntegrator::make_full_solver() {
  matrix_ = full_->make_matrix(context_);
  klu_ = make_klu(matrix_.get(), context_);
  functions_.setup = [this] {
    const Measure measure(statistics_.factorization);
    return static_cast<int>(SUNLinSolSetup(klu_.get(), matrix_.get()));
  };
  functions_.solve = [this](N_Vector x, N_Vector b, double) {
    const Measure measure(statistics_.solve);
    return static_cast<int>(SUNLinSolSolve(klu_.get(), matrix_.get(), x, b, 0));
  };
  solver_ = make_solver_adapter(functions_, context_);
}

void SundialsIntegrator::linearize_full(double t, N_Vector y) {
  const Measure measure(statistics_.tangent);
  model_.linearize(t, positions(y), velocities(y), settings_.options.tangent(), linearization_);
}

void SundialsIntegrator::update_statistics() {
  const Counters now = counters();
  auto& s = statistics_;
  s.steps = before_.steps + now.steps;
  s.error_test_failures = before_.error_test_failures + now.error_test_failures;
  s.convergence_failures = before_.convergence_failures + now.convergence_failures;
  s.rejected_steps = s.error_test_failures + s.convergence_failures;
  s.newton_iterations = before_.newton_iterations + now.newton_iterations;
}

void SundialsIntegrator::fail(int flag) {
  if (callback_context_.failure) std::rethrow_exception(callback_context_.failure);
  const Reason reason = classify(flag);
  switch (reason) {
    case Reason::error_test:
      throw RunError(position() + "the error test keeps failing" + cause() +
                         "; raise integrator.rtol, lower integrator.h_min, or look for a kink in the loads",
                     reason);
    case Reason::newton: throw RunError(position() + iteration_failure(), reason);
    case Reason::force:
      throw RunError(position() + "the force cannot be evaluated" + cause() + "; lower integrator." +
                         (adaptive() ? "h_max" : "step") + " or check the loads",
                     reason);
    case Reason::diverged:
      throw RunError(position() +
                         "the motion has outgrown its tolerance, rtol times the scales, which is below its "
                         "round-off; " +
                         (adaptive() ? "raise integrator.rtol or the scales" : "lower integrator.step"),
                     reason);
    case Reason::step_too_small: throw RunError(position() + "the time left is below the resolution of time", reason);
    default: throw RunError(position() + callback_context_.message + fmt::format(" (flag {})", flag), reason);
  }
}

std::string SundialsIntegrator::iteration_failure() const {
  return "Newton's method does not converge" +
         (adaptive() ? " at the smallest step" + cause() +
                           "; set integrator.gauss_newton: true, lower rtol or h_min, or check for inverted elements"
                     : cause() +
                           "; lower integrator.step, set integrator.gauss_newton: true, or check for inverted "
                           "elements");
}

void SundialsIntegrator::initial_acceleration(const Model& model, double t, VectorRef a) {
  try {
    const Measure measure(statistics_.force);
    model.force(t, positions(y()), velocities(y()), a);
    require_finite(model, a);
  } catch (const RecoverableError& e) {
    throw RunError(fmt::format("{} stopped at t = {:.6g} s: the force cannot be evaluated ({}); check the initial "
                               "state and the loads",
                               name_, t, e.what()),
                   Reason::force);
  }
  model.solve_mass(a);
}

}  // namespace orthodyn::sundials
