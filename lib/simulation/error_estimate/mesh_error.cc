#include "lib/simulation/error_estimate/mesh_error.h"

#include <algorithm>
#include <cmath>

namespace orthodyn {

namespace {

constexpr std::size_t kStates = 8;
constexpr double kDeformed = 1e-6;  // elastic over kinetic energy; less is a rigid-body motion

// Elastic energy of the elements, J. Springs and contact are left out.
double energy_of_elements(const FemModel& model, const State& state) {
  const NodalExpansion nodal(model.parts(), state.t, state.q, state.v);
  double sum = 0;
  for (const auto& term : model.parts().elastic) sum += term->energy(nodal.state());
  return sum;
}

}  // namespace

MeshErrorRecorder::MeshErrorRecorder(std::size_t outputs, const FemModel* only_most_deformed)
    : only_most_deformed_(only_most_deformed),
      outputs_(outputs),
      stride_(std::max<std::size_t>((outputs + kStates - 1) / kStates, 1)) {}

void MeshErrorRecorder::on_output(const ObservedState& observed) {
  ++seen_;
  if (seen_ % stride_ == 0 || seen_ == outputs_) observe(observed);
}

void MeshErrorRecorder::observe(const ObservedState& observed) {
  const auto energy = only_most_deformed_
                          ? std::vector<double>{0, energy_of_elements(*only_most_deformed_, observed.state())}
                          : observed.evaluate("energy.mesh_error");
  if (!std::isfinite(energy[0]) || !std::isfinite(energy[1])) return;  // inverted elements
  error_ += energy[0];
  elastic_ += energy[1];
  kinetic_ += observed.evaluate("energy.kinetic")[0];
  ++samples_;
  if (!(energy[1] > largest_)) return;
  largest_ = energy[1];
  most_deformed_ = observed.state();
}

std::optional<MeshError> MeshErrorRecorder::found() const {
  if (!(elastic_ > kDeformed * kinetic_)) return std::nullopt;
  if (!only_most_deformed_) return MeshError{.relative = error_ / (error_ + elastic_), .samples = samples_};
  const auto energy = only_most_deformed_->evaluate("energy.mesh_error", *most_deformed_);
  if (!std::isfinite(energy[0]) || !(energy[1] > 0)) return std::nullopt;
  return MeshError{.relative = energy[0] / (energy[0] + energy[1]), .samples = 1};
}

}  // namespace orthodyn
