#include "lib/simulation/error_estimate/accumulated_error.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>

#include "lib/config/registry.h"
#include "lib/linear/solver.h"
#include "lib/simulation/run/run.h"

namespace orthodyn {

namespace {

constexpr std::size_t kMostParts = 4;
constexpr double kFiner = 10, kLoosest = 1e-4;  // than rtol; and what it is refined from at most
constexpr int kLargestExplicit = 10'000;        // unknowns of a run without a factor

double mass_norm(const Model& model, const Vector& x) {
  Vector Mx(x.size());
  model.multiply_mass(x, Mx);
  return std::sqrt(std::max(x.dot(Mx), 0.0));
}

// |dq|_M of what a difference of velocities leads to in a time, s: dv/omega of a vibration, dv times the time where
// there is no stiffness. With s = 1/time^2 that is the root of dv' M (K + s M)^-1 M dv, K at this state.
double displacement_from(const Model& model, const State& at, const Vector& dv, double time) {
  const double shift = 1 / (time * time);
  Linearization tangent;
  model.linearize(at.t, at.q, at.v, TangentKind::gauss_newton, tangent);
  std::vector<double> values(model.pattern().row.size());
  model.combine({shift, 0, 1}, tangent, values.data());
  const auto solver = make_solver_for(model.pattern());
  Vector momentum(dv.size()), x(dv.size());
  model.multiply_mass(dv, momentum);
  if (solver->factor(values.data()) != FactorStatus::ok) return mass_norm(model, dv) * time;
  solver->solve(momentum, x);
  return std::sqrt(std::max(x.dot(momentum), 0.0));
}

// At the end of the part. None where the second integration fails or is interrupted.
std::optional<State> integrated_again(const Model& model, Integrator& integrator, const PartRecorder::Part& part,
                                      const std::atomic<bool>& interrupt) {
  Plan plan;
  plan.end = part.end.t;
  const Outcome outcome = run(model, integrator, part.begin, plan, {}, interrupt);
  if (outcome.status != Outcome::Status::completed) return std::nullopt;
  return outcome.last;
}

// What is left at the end of errors that were made at an even rate between two times before it.
double mean_decay(double rate, double from_before_end, double to_before_end) {
  const double span = from_before_end - to_before_end;
  if (rate * span < 1e-6) return std::exp(-rate * to_before_end);
  return (std::exp(-rate * to_before_end) - std::exp(-rate * from_before_end)) / (rate * span);
}

// More accurate than the run, by the same scales.
std::unique_ptr<Integrator> finer_integrator(const Setup& setup, double rtol) {
  const Model& model = *setup.built.model;
  const IntegratorSettings own = Registry<IntegratorChoice>::read(setup.config.at("integrator"))->settings();
  const SolverChoice solver = own.linear_solver.value_or(model.pattern().symmetric ? "auto" : "klu");
  return Registry<IntegratorChoice>::entries()
      .at("arkode_dirk")
      .make()
      ->with({.rtol = rtol,
              .position_scale = own.position_scale,
              .velocity_scale = own.velocity_scale,
              .linear_solver = solver})
      ->make(model, task_of(setup.scene, setup.built));
}

double finer_tolerance(const Setup& setup) {
  const auto own = Registry<IntegratorChoice>::read(setup.config.at("integrator"))->settings().rtol;
  return std::max(std::min(own.value_or(kLoosest), kLoosest) / kFiner, 1e-12);
}

}  // namespace

void PartRecorder::start(const ObservedState& observed) {
  since_ = observed.t();
  measure(observed);
}

void PartRecorder::on_step(const StepInfo& info, const ObservedState& observed, const Integrator& integrator) {
  if (info.h > integrator.smooth_time()) return;  // exact in time: parts of many periods would cost a whole run
  ++step_;
  if (open_ && step_ == opened_at_ + kSteps) {
    add_powers(observed);
    open_->end = observed.state();
    parts_.push_back(std::move(*open_));
    open_.reset();
    if (parts_.size() < kMostParts) return;
    for (std::size_t k = 0; k < parts_.size(); ++k) parts_.erase(parts_.begin() + static_cast<std::ptrdiff_t>(k));
    stride_ *= 2;
  } else if (step_ % stride_ == 0) {
    add_powers(observed);
    open_ = Part{observed.state(), {}};
    opened_at_ = step_;
  }
}

void PartRecorder::measure(const ObservedState& observed) {
  displacement_ = std::max(displacement_, mass_norm(model_, observed.state().q));
}

void PartRecorder::add_powers(const ObservedState& observed) {
  measure(observed);
  if (!model_.traits().dissipative) return;
  dissipated_ += observed.evaluate("power.dissipated")[0];
  kinetic_ += observed.evaluate("energy.kinetic")[0];
}

// An amplitude that falls by `rate` takes energy by twice that rate, and the energy is twice the kinetic one on
// average.
double PartRecorder::decay() const { return kinetic_ > 0 ? dissipated_ / (4 * kinetic_) : 0; }

std::optional<AccumulatedError> accumulated_error(const Setup& setup, const Integrator& run,
                                                  const PartRecorder& recorder, double end,
                                                  const std::atomic<bool>& interrupt) {
  const auto begin = std::chrono::steady_clock::now();
  const Model& model = *setup.built.model;
  const auto& parts = recorder.parts();
  if (parts.empty() || !(recorder.displacement() > 0)) return std::nullopt;
  if (run.factor_bytes() == 0 && model.num_dofs() > kLargestExplicit) return std::nullopt;
  const double rtol = finer_tolerance(setup);
  const auto finer = finer_integrator(setup, rtol);
  AccumulatedError out{.parts = static_cast<int>(parts.size()),
                       .steps = PartRecorder::kSteps,
                       .since = recorder.since(),
                       .against = fmt::format("arkode_dirk at rtol {:.2g}", rtol)};
  const double share = static_cast<double>(recorder.steps()) / static_cast<double>(parts.size() * PartRecorder::kSteps);
  double from = recorder.since();
  for (std::size_t k = 0; k < parts.size(); ++k) {
    const auto& [first, last] = parts[k];
    const auto exact = integrated_again(model, *finer, parts[k], interrupt);
    if (!exact) return std::nullopt;
    const double error = std::hypot(mass_norm(model, last.q - exact->q),
                                    displacement_from(model, last, last.v - exact->v, end - first.t));
    const double to = k + 1 < parts.size() ? 0.5 * (first.t + parts[k + 1].begin.t) : end;  // what it stands for
    out.error += share * error / recorder.displacement() * mean_decay(recorder.decay(), end - from, end - to);
    from = to;
  }
  out.wall_seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  return out;
}

}  // namespace orthodyn
