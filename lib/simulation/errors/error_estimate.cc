#include "lib/simulation/errors/error_estimate.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "lib/config/values.h"
#include "lib/simulation/setup.h"

namespace orthodyn {

namespace {

constexpr std::size_t kSamples = 200;
constexpr double kBytes = 1e9;      // for the samples of both runs
constexpr double kRefinement = 10;  // of rtol
constexpr long kMoreSteps = 10;

bool is_given(const Config& section, const std::string& key) {
  return section.has(key) && !section.at(key).is_null();
}

std::size_t stride_for(std::size_t outputs, std::size_t samples) { return (outputs + samples - 1) / samples; }

// A time, with or without its unit.
double seconds(const Config& value) { return read_number(value, {.unit = "s"}); }

ErrorNorms scaled(const ErrorNorms& e, double factor) { return {factor * e.final, factor * e.l2, factor * e.max}; }

// A copy that can be changed; files in it are found as before.
Config copy(const Config& config) { return Config::from_text(config.dump(), config.file()); }

}  // namespace

std::size_t samples_within(double bytes, std::size_t unknowns) {
  const double one = 2.0 * 2 * sizeof(double) * static_cast<double>(std::max<std::size_t>(unknowns, 1));  // q and v, twice
  return static_cast<std::size_t>(std::clamp(bytes / one, 2.0, double{kSamples}));
}

ErrorEstimator::SampleRecorder::SampleRecorder(std::size_t outputs, std::size_t samples)
    : outputs_(outputs), stride_(std::max<std::size_t>(stride_for(outputs, samples), 1)),
      samples_((outputs + stride_ - 1) / stride_) {}

void ErrorEstimator::SampleRecorder::on_output(const State& state) {
  ++seen_;
  if (seen_ % stride_ == 0 || seen_ == outputs_) samples_.on_output(state);
}

ErrorEstimator::ErrorEstimator(const Setup& setup, Plan plan)
    : setup_(setup), plan_(std::move(plan)), refined_(copy(setup.config)),
      samples_(samples_within(kBytes, static_cast<std::size_t>(setup.built.model->num_dofs()))),
      first_(plan_.output_times.size(), samples_) {
  if (plan_.output_times.empty())
    setup.config.at("output").fail("an error is estimated at the output times, and there are none; set frames");
  const Config integrator = setup.config.at("integrator");
  fixed_step_ = is_given(integrator, "step");
  const auto change = [&](const std::string& key, double value) {
    refinement_.push_back(fmt::format("integrator.{}={:.12g}", key, value));
  };
  if (fixed_step_) change("step", seconds(integrator.at("step")) / 2);
  if (is_given(integrator, "rtol")) change("rtol", read_number(integrator.at("rtol"), {}) / kRefinement);
  if (refinement_.empty()) integrator.fail("has neither rtol nor step, so that no more accurate run can be made");
  // Where they, and not rtol, decide on the steps.
  if (is_given(integrator, "h_max")) change("h_max", seconds(integrator.at("h_max")) / 2);
  if (is_given(integrator, "h_min") && seconds(integrator.at("h_min")) > 0) change("h_min", 0);
  if (is_given(integrator, "h0") && integrator.has("h_max")) change("h0", seconds(integrator.at("h0")) / 2);
  if (is_given(integrator, "max_steps"))
    refinement_.push_back(fmt::format("integrator.max_steps={}", kMoreSteps * integrator.at("max_steps").integer()));
  for (const auto& assignment : refinement_) refined_.override_with(assignment);
  refined_scene_ = read_scene(refined_);  // refused now, not after the first run
}

ErrorEstimate ErrorEstimator::estimate(std::vector<Observer*> observers, const std::atomic<bool>& interrupt) const {
  const Model& model = *setup_.built.model;
  ErrorEstimate estimate;
  estimate.against = refinement_.front();
  const auto integrator =
      refined_scene_.integrator->make(model, task_of(setup_.scene, setup_.built));
  SampleRecorder second(plan_.output_times.size(), samples_);
  observers.push_back(&second);
  const Outcome outcome = run(model, *integrator, setup_.built.initial, plan_, observers, interrupt);
  estimate.wall_seconds = outcome.wall_seconds;
  estimate.completed = outcome.status == Outcome::Status::completed;
  if (!estimate.completed) {
    estimate.trouble = outcome.status == Outcome::Status::interrupted ? "interrupted" : outcome.message;
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
