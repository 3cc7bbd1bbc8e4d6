#include "lib/simulation/error_estimate/error_estimate.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <string>

#include "lib/config/registry.h"
#include "lib/simulation/run/setup.h"

namespace orthodyn {

namespace {

constexpr std::size_t kMaxSamples = 200;
constexpr double kBytes = 1e9;      // for the samples of both runs
constexpr double kRefinement = 10;  // rtol of the first run over that of the second
constexpr long kMoreSteps = 10;

std::size_t stride_for(std::size_t outputs, std::size_t samples) { return (outputs + samples - 1) / samples; }

ErrorNorms scaled(const ErrorNorms& e, double factor) { return {factor * e.final, factor * e.l2, factor * e.max}; }

// Rounds to the number of digits shown in messages.
double rounded(double x) { return std::strtod(fmt::format("{:.12g}", x).c_str(), nullptr); }

// Settings that make the second run more accurate.
IntegratorSettings refined(const IntegratorSettings& own) {
  IntegratorSettings more;
  if (own.step) more.step = rounded(*own.step / 2);
  if (own.safety && !own.step) more.safety = rounded(*own.safety / 2);  // the step is `safety` times the critical step
  if (own.rtol) more.rtol = rounded(*own.rtol / kRefinement);
  if (own.modes) more.modes = 2 * *own.modes;
  if (own.below) more.below = rounded(2 * *own.below);
  if (own.h_max) more.h_max = rounded(*own.h_max / 2);
  if (own.h_min && *own.h_min > 0) more.h_min = 0;
  if (own.h0 && own.h_max) more.h0 = rounded(*own.h0 / 2);
  if (own.max_steps) more.max_steps = kMoreSteps * *own.max_steps;
  return more;
}

std::vector<std::string> assignments(const IntegratorSettings& settings) {
  std::vector<std::string> all;
  for (const auto& [key, value] : numeric_settings(settings))
    all.push_back(fmt::format("integrator.{}={:.12g}", key, value));
  return all;
}

}  // namespace

std::size_t samples_within(double bytes, std::size_t unknowns) {
  const double one =
      2.0 * 2 * sizeof(double) * static_cast<double>(std::max<std::size_t>(unknowns, 1));  // q and v of two runs
  return static_cast<std::size_t>(std::clamp(bytes / one, 2.0, double{kMaxSamples}));
}

ErrorEstimator::SampleRecorder::SampleRecorder(std::size_t outputs, std::size_t samples)
    : outputs_(outputs),
      stride_(std::max<std::size_t>(stride_for(outputs, samples), 1)),
      samples_((outputs + stride_ - 1) / stride_) {}

void ErrorEstimator::SampleRecorder::on_output(const ObservedState& observed) {
  ++seen_;
  if (seen_ % stride_ == 0 || seen_ == outputs_) samples_.on_output(observed);
}

ErrorEstimator::ErrorEstimator(const Setup& setup, Plan plan)
    : setup_(setup),
      plan_(std::move(plan)),
      samples_(samples_within(kBytes, static_cast<std::size_t>(setup.built.model->num_dofs()))),
      first_(plan_.output_times.size(), samples_) {
  if (plan_.output_times.empty())
    setup.config.at("output").fail("the error is estimated at output times, and there are none; set output.frames");
  const Config section = setup.config.at("integrator");
  const auto resolved = Registry<IntegratorChoice>::read(section);  // including decisions of the first run
  const IntegratorSettings own = resolved->settings();
  if (!own.step && !own.rtol && !own.safety)
    section.fail("has none of rtol, step and safety, so that --estimate-error cannot make a more accurate run");
  fixed_step_ = own.step.has_value();
  const IntegratorSettings finer = refined(own);
  refinement_ = assignments(finer);
  try {
    refined_ = resolved->with(finer);
  } catch (const ConfigError& e) {
    section.fail(e.message());
  }
}

ErrorEstimate ErrorEstimator::estimate(std::vector<Observer*> observers, const std::atomic<bool>& interrupt) const {
  const FemModel& model = *setup_.built.model;
  ErrorEstimate estimate;
  estimate.against = refinement_.front();
  const auto integrator = refined_->make(model, task_of(setup_.scene, setup_.built));
  SampleRecorder second(plan_.output_times.size(), samples_);
  observers.push_back(&second);
  const Outcome outcome = run(model, *integrator, setup_.built.initial, plan_, observers, interrupt);
  estimate.wall_seconds = outcome.wall_seconds;
  estimate.completed = outcome.status == Outcome::Status::completed;
  if (!estimate.completed) {
    estimate.failure_reason = outcome.status == Outcome::Status::interrupted ? "interrupted" : outcome.message;
    return estimate;
  }
  const double factor = fixed_step_ ? 1 + 1 / (std::exp2(second.order()) - 1) : 1;
  const auto errors = ReferenceNorms(model, second.trajectory(), {}).errors(first_.trajectory());
  estimate.displacement = scaled(errors.displacement, factor);
  estimate.velocity = scaled(errors.velocity, factor);
  estimate.samples = static_cast<int>(first_.trajectory().times.size());
  return estimate;
}

}  // namespace orthodyn
