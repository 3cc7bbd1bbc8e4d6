#include "integrators/native/explicit_step.h"

#include <fmt/format.h>

#include <utility>

#include "integrators/run_checks.h"
#include "lib/core/cause.h"
#include "lib/ode/constraints_at.h"

namespace orthodyn {

ExplicitStep::ExplicitStep(const Model& model, const Remedies& remedies, int order, long max_steps)
    : model_(model), remedies_(remedies), order_(order), max_steps_(max_steps) {
  const Vector zero = Vector::Zero(model.num_dofs());
  begin_ = end_ = next_ = {0, zero, zero, zero};
}

void ExplicitStep::start(const State& state) {
  end_.t = state.t;
  end_.q = state.q;
  end_.v = state.v;
  if (model_.constraints()) {
    ConstraintsAt(model_, end_.t, end_.q).fit_positions(end_.q);
    ConstraintsAt(model_, end_.t, end_.q).fit(end_.v);
  }
  try {
    acceleration(end_.t, end_.q, end_.v, end_.a);
    begin(end_);
  } catch (const RecoverableError& e) {
    throw initial_force_error(remedies_.name, end_.t, e.what());
  }
}

std::optional<State> ExplicitStep::mean_of_step() const {
  if (begin_.t == end_.t) return std::nullopt;
  return orthodyn::mean_state(begin_, end_);
}

StepInfo ExplicitStep::step(double t_stop) {
  if (statistics_.steps >= max_steps_)
    throw too_many_steps_error(remedies_.name, end_.t, statistics_.steps, remedies_.fewer);
  try {
    advance(t_stop);
  } catch (const RecoverableError& e) {
    Cause cause;
    cause.note(e);
    fail(cause.explain("the force cannot be evaluated", "; " + remedies_.shorter + " or check the loads"),
         Reason::force);
  }
  std::swap(begin_, end_);
  std::swap(end_, next_);
  ++statistics_.steps;
  return {end_.t, end_.t - begin_.t, order_};
}

void ExplicitStep::interpolate(double t, State& out) const {
  out.t = t;
  out.q.resize(end_.q.size());
  out.v.resize(end_.v.size());
  if (t == end_.t) {
    out.q = end_.q;
    out.v = end_.v;
    out.lambda = end_.lambda;
    return;
  }
  if (model_.constraints()) {
    const double s = (t - begin_.t) / (end_.t - begin_.t);
    out.lambda = (1 - s) * begin_.lambda + s * end_.lambda;
  }
  orthodyn::interpolate(begin_, end_, t, out.q, out.v);
}

void ExplicitStep::acceleration(double t, const ConstVectorRef& q, const ConstVectorRef& v, VectorRef a) {
  const Measure measure(statistics_.force);
  model_.force(t, q, v, a);
  require_finite(model_, a);
  model_.solve_mass(a);
}

void ExplicitStep::fail(const std::string& problem, Reason reason) const {
  throw RunError(fmt::format("{} stopped at t = {:.6g} s: {}", remedies_.name, end_.t, problem), reason);
}

}  // namespace orthodyn
