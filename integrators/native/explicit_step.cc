#include "integrators/native/explicit_step.h"

#include <fmt/format.h>

#include <utility>

#include "integrators/finite_force.h"

namespace orthodyn {

ExplicitStep::ExplicitStep(const Model& model, const Words& words, int order, long max_steps)
    : model_(model), words_(words), order_(order), max_steps_(max_steps) {
  const Vector zero = Vector::Zero(model.num_dofs());
  begin_ = end_ = next_ = {0, zero, zero, zero};
}

void ExplicitStep::start(const State& state) {
  end_.t = state.t;
  end_.q = state.q;
  end_.v = state.v;
  try {
    acceleration(end_.t, end_.q, end_.v, end_.a);
    begin();
  } catch (const RecoverableError& e) {
    fail(fmt::format("the force cannot be evaluated ({}); check the initial state and the loads", e.what()),
         Reason::force);
  }
}

std::optional<State> ExplicitStep::mean_of_step() const {
  if (begin_.t == end_.t) return std::nullopt;
  return orthodyn::mean_state(begin_, end_);
}

StepInfo ExplicitStep::step(double t_stop) {
  if (statistics_.steps >= max_steps_)
    throw RunError(
        fmt::format("{} gave up at t = {:.6g} s after {} steps (max_steps); raise integrator.max_steps{}", words_.name,
                    end_.t, statistics_.steps, words_.fewer.empty() ? "" : " or " + words_.fewer),
        Reason::too_many_steps);
  try {
    advance(t_stop);
  } catch (const RecoverableError& e) {
    fail(fmt::format("the force cannot be evaluated ({}); {} or check the loads", e.what(), words_.shorter),
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
    return;
  }
  orthodyn::interpolate(begin_, end_, t, out.q, out.v);
}

void ExplicitStep::acceleration(double t, const ConstVectorRef& q, const ConstVectorRef& v, VectorRef a) {
  const Measure measure(statistics_.force);
  model_.force(t, q, v, a);
  require_finite(model_, a);
  model_.solve_mass(a);
}

void ExplicitStep::fail(const std::string& what, Reason reason) const {
  throw RunError(fmt::format("{} stopped at t = {:.6g} s: {}", words_.name, end_.t, what), reason);
}

}  // namespace orthodyn
