#include "lib/simulation/error_estimate/linear_phase_error.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "lib/simulation/error_estimate/mass_norm.h"

namespace orthodyn {

namespace {

constexpr double kPart = 0.25;  // least duration of a window over the time elapsed before it

std::vector<double> numbers_of(const Vector& x) { return {x.begin(), x.end()}; }

}  // namespace

PhaseError::PhaseError(const FemModel& model, double start)
    : model_(model), start_(start), time_(start), window_(empty()) {}

PhaseError::Window PhaseError::empty() const {
  const Vector zero = Vector::Zero(model_.num_dofs());
  return {.t = time_, .mean = zero, .farthest = zero};
}

void PhaseError::observe(const State& state) {
  const double h = state.t - time_;
  if (!(h > 0)) return;
  time_ = state.t;
  const Vector swing = state.q - window_.mean;
  const double distance = window_.duration > 0 ? std::max(mass_product(model_, swing), 0.0) : 0,
               share = h / (window_.duration + h);
  window_.swings += window_.duration * share * distance;
  window_.mean += share * swing;
  window_.duration += h;
  window_.velocities += h * std::max(mass_product(model_, state.v), 0.0);
  if (distance < window_.square) return;
  window_.t = state.t;
  window_.square = distance;
  window_.farthest = state.q;
}

double PhaseError::frequency() const { return window_.swings > 0 ? std::sqrt(window_.velocities / window_.swings) : 0; }

bool PhaseError::is_full() const {
  const double before = time_ - window_.duration - start_;
  return window_.duration > 0 && window_.duration >= kPart * before &&
         frequency() * window_.duration >= 2 * std::numbers::pi;
}

void PhaseError::integrate_window(Linearity& linearity) {
  if (frequency() > 0) {
    const VibrationDrift drift = linearity.drift(window_.t, window_.mean, window_.farthest - window_.mean, frequency());
    error_ = error_ * std::exp(-drift.decay * window_.duration) + drift.after(window_.duration);
    largest_error_ = std::max(largest_error_, error_);
  }
  discard_window();
}

void PhaseError::discard_window() { window_ = empty(); }

double PhaseError::error_with_window(Linearity& linearity) const {
  PhaseError with_the_rest = *this;
  with_the_rest.integrate_window(linearity);
  return with_the_rest.largest_error_;
}

void PhaseError::save(Archive& archive) const {
  archive.put("phase", {time_, window_.duration, window_.swings, window_.velocities, window_.t, window_.square, error_,
                        largest_error_});
  archive.put("mean", numbers_of(window_.mean));
  archive.put("farthest", numbers_of(window_.farthest));
}

void PhaseError::restore(const Archive& archive) {
  const auto vector = [&](const char* name) {
    const auto& x = archive.numbers(name, static_cast<std::size_t>(model_.num_dofs()));
    return Vector(Eigen::Map<const Vector>(x.data(), model_.num_dofs()));
  };
  const auto& found = archive.numbers("phase", 8);
  time_ = found[0];
  window_ = {found[1], found[2], found[3], found[4], found[5], vector("mean"), vector("farthest")};
  error_ = found[6], largest_error_ = found[7];
}

}  // namespace orthodyn
