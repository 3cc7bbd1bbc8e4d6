#include "lib/simulation/error_estimate/segment_error_estimate.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>

#include "lib/config/registry.h"
#include "lib/linear/solver.h"
#include "lib/simulation/error_estimate/mass_norm.h"
#include "lib/simulation/run/run.h"

namespace orthodyn {

namespace {

constexpr std::size_t kMaxSegments = 4;
constexpr double kFiner = 10, kLoosest = 1e-4;  // rtol of the run, at most kLoosest, over the second rtol
constexpr int kLargestExplicit = 10'000;        // most unknowns if the run used no factorisation

// Displacement |dq|_M that a velocity difference dv causes within `time` (s): |dv|_M / omega for a vibration,
// |dv|_M * time without stiffness. Computed as sqrt(dv^T M (K + s M)^-1 M dv) with s = 1/time^2 and K at this state.
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

// The state at the end of the segment; empty if the second integration fails or is interrupted.
std::optional<State> integrated_again(const Model& model, Integrator& integrator,
                                      const SegmentRecorder::Segment& segment, const std::atomic<bool>& interrupt) {
  Plan plan;
  plan.end = segment.end.t;
  const Outcome outcome = run(model, integrator, segment.begin, plan, {}, interrupt);
  if (outcome.status != Outcome::Status::completed) return std::nullopt;
  return outcome.last;
}

// Mean factor by which errors have decayed at the end of the run. `rate`: decay rate, 1/s. The errors are made at a
// constant rate between two times, given as the time left until the end (s).
double mean_decay(double rate, double from_before_end, double to_before_end) {
  const double span = from_before_end - to_before_end;
  if (rate * span < 1e-6) return std::exp(-rate * to_before_end);
  return (std::exp(-rate * to_before_end) - std::exp(-rate * from_before_end)) / (rate * span);
}

// An integrator more accurate than the run's, with the same scales.
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

void SegmentRecorder::start(const ObservedState& observed) {
  since_ = observed.t();
  measure(observed);
}

void SegmentRecorder::on_step(const StepInfo& info, const ObservedState& observed, const Integrator& integrator) {
  if (info.h > integrator.smooth_time())
    return;  // exact in time; repeating such long steps would cost as much as the run
  ++step_;
  if (open_ && step_ == opened_at_ + kSteps) {
    add_powers(observed);
    open_->end = observed.state();
    segments_.push_back(std::move(*open_));
    open_.reset();
    if (segments_.size() < kMaxSegments) return;
    for (std::size_t k = 0; k < segments_.size(); ++k)
      segments_.erase(segments_.begin() + static_cast<std::ptrdiff_t>(k));
    stride_ *= 2;
  } else if (step_ % stride_ == 0) {
    add_powers(observed);
    open_ = Segment{observed.state(), {}};
    opened_at_ = step_;
  }
}

void SegmentRecorder::measure(const ObservedState& observed) {
  displacement_ = std::max(displacement_, mass_norm(model_, observed.state().q));
}

void SegmentRecorder::add_powers(const ObservedState& observed) {
  measure(observed);
  if (!model_.traits().dissipative) return;
  dissipated_ += observed.evaluate("power.dissipated")[0];
  kinetic_ += observed.evaluate("energy.kinetic")[0];
}

// If the amplitude decays at a rate g, the energy decays at 2 g. The energy is twice the mean kinetic energy T, so that
// g = dissipated power / (4 T).
// A creeping body dissipates without vibrating.
double SegmentRecorder::decay() const {
  return kinetic_ > 0 && !model_.internal_variables() ? dissipated_ / (4 * kinetic_) : 0;
}

std::optional<SegmentErrorEstimate> segment_error_estimate(const Setup& setup, const Integrator& run,
                                                           const SegmentRecorder& recorder, double end,
                                                           const std::atomic<bool>& interrupt) {
  const auto begin = std::chrono::steady_clock::now();
  const Model& model = *setup.built.model;
  const auto& segments = recorder.segments();
  if (segments.empty() || !(recorder.displacement() > 0)) return std::nullopt;
  if (model.constraints()) return std::nullopt;  // the method that integrates again does not solve them
  if (run.factor_bytes() == 0 && model.num_dofs() > kLargestExplicit) return std::nullopt;
  const double rtol = finer_tolerance(setup);
  const auto finer = finer_integrator(setup, rtol);
  SegmentErrorEstimate out{.segments = static_cast<int>(segments.size()),
                           .steps = SegmentRecorder::kSteps,
                           .since = recorder.since(),
                           .against = fmt::format("arkode_dirk at rtol {:.2g}", rtol)};
  const double share =
      static_cast<double>(recorder.steps()) / static_cast<double>(segments.size() * SegmentRecorder::kSteps);
  double from = recorder.since();
  for (std::size_t k = 0; k < segments.size(); ++k) {
    const auto& [first, last] = segments[k];
    const auto exact = integrated_again(model, *finer, segments[k], interrupt);
    if (!exact) return std::nullopt;
    const double error = std::hypot(mass_norm(model, last.q - exact->q),
                                    displacement_from(model, last, last.v - exact->v, end - first.t));
    const double to = k + 1 < segments.size() ? 0.5 * (first.t + segments[k + 1].begin.t)
                                              : end;  // end of the interval that the segment stands for
    out.error += share * error / recorder.displacement() * mean_decay(recorder.decay(), end - from, end - to);
    from = to;
  }
  out.wall_seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  return out;
}

}  // namespace orthodyn
