#include "lib/simulation/errors/accumulated_error.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>

#include "lib/config/registry.h"
#include "lib/linear/solver.h"
#include "lib/simulation/run.h"

namespace orthodyn {

namespace {

constexpr std::size_t kMostParts = 6;
constexpr double kFiner = 10, kLoosest = 1e-4;  // than rtol; and what it is refined from at most

double mass_norm(const Model& model, const Vector& x) {
  Vector Mx(x.size());
  model.multiply_mass(x, Mx);
  return std::sqrt(std::max(x.dot(Mx), 0.0));
}

// Vibrations of amplitude A lose twice their rate of decay times their energy, which is twice the kinetic one on
// average.
double decay_rate(const ObservedState& at) {
  const double kinetic = at.evaluate("energy.kinetic")[0];
  return kinetic > 0 ? at.evaluate("power.dissipated")[0] / (4 * kinetic) : 0;
}

// |dq|_M of what a difference of velocities leads to in a time, s: dv/omega of a vibration, dv times the time where
// there is no stiffness. With s = 1/time^2 that is the root of dv' M (K + s M)^-1 M dv, K at this state.
double displacement_from(const Model& model, const State& at, const Vector& dv, double time) {
  const double shift = 1 / (time * time);
  Linearization tangent;
  model.linearize(at.t, at.q, at.v, TangentKind::gauss_newton, tangent);
  std::vector<double> values(model.pattern().row.size());
  model.combine({shift, 0, 1}, tangent, values.data());
  const auto solver = solver_registry().at(model.pattern().symmetric ? "cholmod" : "klu").make();
  solver->analyze(model.pattern());
  Vector momentum(dv.size()), x(dv.size());
  model.multiply_mass(dv, momentum);
  if (solver->factor(values.data()) != FactorStatus::ok) return mass_norm(model, dv) * time;
  solver->solve(momentum, x);
  return std::sqrt(std::max(x.dot(momentum), 0.0));
}

// At the end of the part. None where the second integration fails or is interrupted.
std::optional<State> integrated_again(const Setup& setup, const IntegratorChoice& method,
                                      const PartRecorder::Part& part, const std::atomic<bool>& interrupt) {
  const Model& model = *setup.built.model;
  const auto integrator = method.make(model, task_of(setup.scene, setup.built));
  Plan plan;
  plan.end = part.end.t;
  const Outcome outcome = run(model, *integrator, part.begin, plan, {}, interrupt);
  if (outcome.status != Outcome::Status::completed) return std::nullopt;
  return outcome.last;
}

}  // namespace

void PartRecorder::on_step(const StepInfo&, const ObservedState& observed, const Integrator&) {
  ++step_;
  if (open_ && step_ == opened_at_ + kSteps) {
    open_->end = observed.state();
    measure(observed);
    parts_.push_back(std::move(*open_));
    open_.reset();
    if (parts_.size() < kMostParts) return;
    for (std::size_t k = 0; k < parts_.size(); ++k) parts_.erase(parts_.begin() + static_cast<std::ptrdiff_t>(k));
    stride_ *= 2;
  } else if (step_ % stride_ == 0) {
    begin_part(observed);
  }
}

void PartRecorder::measure(const ObservedState& observed) {
  displacement_ = std::max(displacement_, mass_norm(model_, observed.state().q));
}

void PartRecorder::begin_part(const ObservedState& observed) {
  measure(observed);
  open_ = Part{observed.state(), {}, model_.traits().dissipative ? decay_rate(observed) : 0};
  opened_at_ = step_;
}

std::optional<AccumulatedError> accumulated_error(const Setup& setup, const PartRecorder& recorder, long steps,
                                                  double end, const std::atomic<bool>& interrupt) {
  const auto begin = std::chrono::steady_clock::now();
  const auto& parts = recorder.parts();
  if (parts.empty() || !(recorder.displacement() > 0)) return std::nullopt;
  const IntegratorSettings own = Registry<IntegratorChoice>::read(setup.config.at("integrator"))->settings();
  const double rtol = std::max(std::min(own.rtol.value_or(kLoosest), kLoosest) / kFiner, 1e-12);
  const auto method = Registry<IntegratorChoice>::entries().at("arkode_dirk").make()->with(
      {.rtol = rtol, .linear_solver = own.linear_solver});
  AccumulatedError out{.parts = static_cast<int>(parts.size()),
                       .steps = PartRecorder::kSteps,
                       .against = fmt::format("arkode_dirk at rtol {:.2g}", rtol)};
  const double share = static_cast<double>(steps) / static_cast<double>(parts.size() * PartRecorder::kSteps);
  for (const PartRecorder::Part& part : parts) {
    const auto exact = integrated_again(setup, *method, part, interrupt);
    if (!exact) return std::nullopt;
    const Model& model = *setup.built.model;
    const double error = std::hypot(mass_norm(model, part.end.q - exact->q),
                                    displacement_from(model, part.end, part.end.v - exact->v, end - part.begin.t));
    out.error += share * error / recorder.displacement() * std::exp(-part.decay * (end - part.end.t));
  }
  out.wall_seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  return out;
}

}  // namespace orthodyn
