#include "integrators/sundials/sundials_integrator.h"

#include <fmt/format.h>

#include <cmath>
#include <limits>

#include "integrators/run_checks.h"
#include "lib/core/versions.h"

namespace orthodyn::sundials {

namespace {

const bool version_registered = library_versions().emplace("SUNDIALS", library_version()).second;

std::optional<GivenInternalModel> internal_model(const Model& model) {
  return model.internal_variables() ? std::optional<GivenInternalModel>(std::in_place, model) : std::nullopt;
}

}  // namespace

SundialsIntegrator::SundialsIntegrator(std::string name, const LibraryCalls& library, const Model& model,
                                       const Options& options, const Scales& scales, bool implicit)
    : model_(model),
      options_(options),
      scales_(scales),
      decisions_(scale_decisions(scales)),
      internal_(internal_model(model)),
      extra_{internal_ ? internal_->internal().size() : 0,
             library.algebraic && model.constraints() ? model.constraints()->size() : 0},
      y_(make_vector(size(), context_, model.ranks())),
      name_(std::move(name)),
      library_(library) {
  if (!implicit) return;
  if (!model.traits().smooth && options.max_newton_iterations < 2)
    throw ConfigError("max_newton_iterations: must be at least 2 for models with contact, found 1");
  newton_system_.emplace(model_, options_, scales_, statistics_, callback_context_);
  if (library.set_factor_interval) renewal_.emplace(renewal_cost(model_));
}

void SundialsIntegrator::check_mass_for_full_jacobian() const {
  if (!options_.is_full() || model_.traits().lumped_mass) return;
  throw ConfigError(
      "linear_solver klu_full under " + name_ +
      " needs `mass: lumped` (the inverse of a consistent mass is dense); use ida_bdf, or klu or cholesky");
}

void SundialsIntegrator::set_error_weights() {
  require(library_.set_user_data(memory(), this));
  require(library_.set_error_weights(memory(), [](N_Vector y, N_Vector weights, void* user) {
    static_cast<SundialsIntegrator*>(user)->set_weights(y, weights);
    return 0;
  }));
}

void SundialsIntegrator::set_weights(N_Vector y, N_Vector weights) {
  const Extra m = extra();
  // SUNDIALS divides the sum of all squares by their number.
  const auto all = static_cast<double>(size());
  const double of_motion = m.size() > 0 ? std::sqrt(all / static_cast<double>(size() - m.size())) : 1;
  if (m.internals > 0) {
    // A strain far below the largest one so far does not matter; at first, neither does one far below that of a motion
    // of the size of the position scale.
    constexpr double kLeastShare = 1e-2;
    const auto z = internal_part(y, m);
    const auto count = static_cast<double>(m.internals);
    largest_strain_ = std::max({largest_strain_, z.norm() / std::sqrt(count),
                                kLeastShare * internal_->internal().strain_of(scales_.position)});
    internal_part(weights, m).setConstant(std::sqrt(all / count) / (options_.rtol * largest_strain_));
  }
  // Multipliers are as accurate as the accelerations allow; their error is not tested.
  if (m.constraints > 0) {
    constexpr double kNone = 1e-100;
    velocity_multipliers(weights, m).setConstant(kNone);
    position_multipliers(weights, m).setConstant(kNone);
  }
  positions(weights, m).setConstant(of_motion / (options_.rtol * scales_.position));
  velocities(weights, m).setConstant(of_motion / (options_.rtol * scales_.velocity));
}

void SundialsIntegrator::set_step_limits() {
  if (options_.h0) require(library_.set_initial_step(memory(), *options_.h0));
  if (options_.h_max) require(library_.set_max_step(memory(), *options_.h_max));
  if (options_.h_min > 0) require(library_.set_min_step(memory(), options_.h_min));
}

void SundialsIntegrator::use_nonsmooth_newton() {
  nonsmooth_newton_.emplace(options_.rtol, y(), context_);
  require(library_.set_nonlinear_solver(memory(), nonsmooth_newton_->get()));
  nonsmooth_newton_->replace_test();
}

void SundialsIntegrator::attach_linear_solver() {
  require(library_.set_linear_solver(memory(), newton_system_->solver(), newton_system_->matrix()));
}

int SundialsIntegrator::step_with_matrix_renewal(const std::function<int()>& attempt) {
  if (!renewal_) return attempt();
  const auto rejected = [this] {
    long count = 0;
    library_.error_test_failures(memory(), &count);
    return count;
  };
  const int every = renewal_->is_due() ? 1 : 0;
  require(library_.set_factor_interval(memory(), every));
  require(library_.set_tangent_interval(memory(), every));
  const long solves = statistics_.solve.count, tangents = statistics_.tangent.count, before = rejected();
  const int flag = attempt();
  // An attempt that the error test rejects says nothing about the matrix: the mean of all attempts counts.
  const auto attempts = static_cast<double>(1 + rejected() - before);
  renewal_->note(static_cast<double>(statistics_.solve.count - solves) / attempts,
                 statistics_.tangent.count > tangents);
  return flag;
}

void SundialsIntegrator::restart_renewal() {
  if (renewal_) renewal_->restart();
}

void SundialsIntegrator::start(const State& state) {
  positions(y(), extra()) = state.q;
  velocities(y(), extra()) = state.v;
  if (internal_) internal_part(y(), extra()) = internals_of(internal_->internal(), state.t, state.q, state.z);
  t_ = state.t;
  if (started_) {
    const Counters now = counters();
    reinitialise(state.t);  // sets the library's counters to zero
    restart_renewal();
    before_.add(now);
  } else {
    initialise(state.t);
    started_ = true;
  }
}

StepInfo SundialsIntegrator::step(double t_stop) {
  if (statistics_.steps >= options_.max_steps)
    throw too_many_steps_error(name_, t_, statistics_.steps, adaptive() ? "integrator.rtol" : "integrator.step");
  callback_context_ = {};
  const int flag = advance(t_stop, t_);
  update_statistics();
  if (flag < 0) fail(flag);
  StepInfo info{t_, 0, last_order()};
  library_.last_step(memory(), &info.h);
  refuse_tiny_steps(info, t_stop);
  return info;
}

// Ends a run whose steps become ever smaller, as before a time past which the model cannot be evaluated.
void SundialsIntegrator::refuse_tiny_steps(const StepInfo& info, double t_stop) const {
  if (info.t >= t_stop || info.h > 4 * std::numeric_limits<double>::epsilon() * std::abs(info.t)) return;
  throw RunError(position() + explained("the step has shrunk to the resolution of time",
                                        "; raise integrator.rtol, lower integrator.h_max or check the loads"),
                 Reason::step_too_small);
}

std::string SundialsIntegrator::position() const {
  return fmt::format("{} stopped at t = {:.6g} s, step {:.3g} s: ", name_, t_, current_step());
}

std::string SundialsIntegrator::explained(const std::string& problem, const std::string& advice) const {
  return callback_context_.recoverable_cause.explain(problem, advice);
}

void SundialsIntegrator::interpolate(double t, State& out) const {
  const auto dense = make_vector(size(), context_, model_.ranks());
  if (dense_output(t, dense.get()) < 0)
    throw RunError(fmt::format("{} cannot interpolate at t = {:.17g} s: {}", name_, t, callback_context_.message));
  out.t = t;
  out.q = positions(dense.get(), extra());
  out.v = velocities(dense.get(), extra());
  out.z = internal_part(dense.get(), extra());
  out.lambda = velocity_multipliers(dense.get(), extra());
}

std::size_t SundialsIntegrator::bytes() const {
  long reals = 0, integers = 0;
  library_.workspace(memory(), &reals, &integers);
  return static_cast<std::size_t>(reals) * sizeof(sunrealtype) + own_bytes() +
         (newton_system_ ? newton_system_->bytes() : 0);
}

Decisions SundialsIntegrator::decisions() const {
  auto all = decisions_;
  if (newton_system_) all.emplace_back("linear_solver", shown(options_.linear_solver) + newton_system_->description());
  return all;
}

void SundialsIntegrator::require(int flag) const {
  if (flag < 0) throw RunError(name_ + " could not be set up: " + callback_context_.message);
}

double SundialsIntegrator::current_step() const {
  sunrealtype h = 0;
  library_.current_step(memory(), &h);
  return h;
}

SundialsIntegrator::Counters SundialsIntegrator::counters() const {
  Counters c;
  library_.steps(memory(), &c.steps);
  library_.error_test_failures(memory(), &c.error_test_failures);
  library_.convergence_failures(memory(), &c.convergence_failures);
  c.convergence_failures += retries();
  library_.newton_iterations(memory(), &c.newton_iterations);
  return c;
}

void SundialsIntegrator::Counters::add(const Counters& other) {
  steps += other.steps;
  error_test_failures += other.error_test_failures;
  convergence_failures += other.convergence_failures;
  newton_iterations += other.newton_iterations;
}

void SundialsIntegrator::update_statistics() {
  Counters all = before_;
  all.add(counters());
  auto& s = statistics_;
  s.steps = all.steps;
  s.error_test_failures = all.error_test_failures;
  s.convergence_failures = all.convergence_failures;
  s.rejected_steps = s.error_test_failures + s.convergence_failures;
  s.newton_iterations = all.newton_iterations;
}

void SundialsIntegrator::fail(int flag) {
  if (callback_context_.failure) std::rethrow_exception(callback_context_.failure);
  const Reason reason = classify(flag);
  switch (reason) {
    case Reason::error_test:
      throw RunError(position() + "the error test keeps failing" + callback_context_.recoverable_cause.in_brackets() +
                         "; raise integrator.rtol, lower integrator.h_min, or look for a kink in the loads",
                     reason);
    case Reason::newton: throw RunError(position() + iteration_failure(), reason);
    case Reason::force:
      throw RunError(position() + explained("the force cannot be evaluated", std::string("; lower integrator.") +
                                                                                 (adaptive() ? "h_max" : "step") +
                                                                                 " or check the loads"),
                     reason);
    case Reason::diverged:
      throw RunError(
          position() +
              "the motion has grown so large that its round-off exceeds the tolerance (rtol times the scales); " +
              (adaptive() ? "raise integrator.rtol or the scales" : "lower integrator.step"),
          reason);
    case Reason::step_too_small: throw RunError(position() + "the time left is below the resolution of time", reason);
    default: throw RunError(position() + callback_context_.message + fmt::format(" (flag {})", flag), reason);
  }
}

std::string SundialsIntegrator::iteration_failure() const {
  const std::string problem = "Newton's method does not converge";
  if (adaptive())
    return explained(problem + " at the smallest step",
                     "; set integrator.gauss_newton: true, lower rtol or h_min, or check for inverted elements");
  return explained(problem,
                   "; lower integrator.step, set integrator.gauss_newton: true, or check for inverted elements");
}

int SundialsIntegrator::evaluate_acceleration(const Model& model, double t, N_Vector y, VectorRef a) {
  return guarded(callback_context_, [&] {
    const Measure measure(statistics_.force);
    with_internals(model, y).force(t, positions(y, extra()), velocities(y, extra()), a);
    require_finite(model, a);
    model.solve_mass(a);
  });
}

const Model& SundialsIntegrator::with_internals(const Model& model, N_Vector y) {
  if (!internal_) return model;
  internal_->set(internal_part(y, extra()).data());
  return *internal_;
}

int SundialsIntegrator::evaluate_internal_rates(double t, N_Vector y, N_Vector y_dot) {
  if (!internal_) return 0;
  return guarded(callback_context_, [&] {
    const Measure measure(statistics_.force);
    const Extra m = extra();
    auto rates = internal_part(y_dot, m);
    internal_->internal().strains(t, positions(y, m), rates);
    rates = (rates - internal_part(y, m)).cwiseQuotient(internal_->internal().relaxation_times());
  });
}

void SundialsIntegrator::initial_acceleration(const Model& model, double t, VectorRef a) {
  try {
    const Measure measure(statistics_.force);
    with_internals(model, y()).force(t, positions(y(), extra()), velocities(y(), extra()), a);
    require_finite(model, a);
  } catch (const RecoverableError& e) {
    throw initial_force_error(name_, t, e.what());
  }
  model.solve_mass(a);
}

}  // namespace orthodyn::sundials
