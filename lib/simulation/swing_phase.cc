#include "lib/simulation/swing_phase.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "lib/core/errors.h"
#include "lib/core/golden.h"

namespace orthodyn {

namespace {

constexpr double kWindows = 24;

}  // namespace

SwingPhase::SwingPhase(const FemModel& model, double start, double span)
    : model_(model), start_(start), width_(span / kWindows), time_(start), mean_(Vector::Zero(model.num_dofs())),
      window_end_(start) {
  begin_window();
}

// The state that is looked at is at another phase of the motion in each window.
void SwingPhase::begin_window() {
  const double begin = std::max(window_end_, time_);
  window_ = {};
  window_end_ = begin + width_;
  look_ = begin + golden_share(static_cast<int>(windows_++)) * width_;
}

double SwingPhase::product(const Vector& x) const {
  Vector Mx(x.size());
  model_.multiply_mass(x, Mx);
  return std::max(x.dot(Mx), 0.0);
}

void SwingPhase::look_at(const State& state) {
  const double h = state.t - time_;
  if (!(h > 0)) return;
  time_ = state.t;
  mean_ += h / (time_ - start_) * (state.q - mean_);
  const Vector swing = state.q - mean_;
  window_.duration += h;
  window_.displacements += h * product(swing);
  window_.velocities += h * product(state.v);
  if (window_.swing.size() == 0 && time_ >= look_) {
    window_.t = time_;
    window_.mean = mean_;
    window_.swing = swing;
  }
  if (time_ < window_end_) return;
  full_.push_back(std::move(window_));
  begin_window();
}

void SwingPhase::evaluate(Linearity& linearity) {
  for (const Window& window : full_) {
    if (!(window.displacements > 0) || window.swing.size() == 0) continue;
    const double square = window.displacements / window.duration;
    const double omega = std::sqrt(window.velocities / window.displacements);
    try {
      phase_ += linearity.softening(window.t, window.mean, window.swing) / (2 * square) * omega * window.duration;
      error_ = std::max(error_, std::abs(phase_) * std::sqrt(2 * square));
    } catch (const RecoverableError&) {
      error_ = std::numeric_limits<double>::infinity();
    }
  }
  full_.clear();
}

void SwingPhase::finish(Linearity& linearity) {
  if (window_.swing.size() > 0) {
    full_.push_back(std::move(window_));
    begin_window();
  }
  evaluate(linearity);
}

void SwingPhase::save(Archive& archive) const {
  archive.put("swing", {time_, window_end_, look_, window_.duration, window_.displacements, window_.velocities,
                        window_.t, phase_, error_});
  archive.put_count("windows", windows_);
  archive.put_count("is_looked_at", window_.swing.size() > 0 ? 1 : 0);
  const auto put = [&](const char* name, const Vector& x) { archive.put(name, std::vector<double>(x.begin(), x.end())); };
  put("mean", mean_);
  if (window_.swing.size() == 0) return;
  put("window_mean", window_.mean);
  put("window_swing", window_.swing);
}

void SwingPhase::restore(const Archive& archive) {
  const auto& found = archive.numbers("swing", 9);
  time_ = found[0], window_end_ = found[1], look_ = found[2];
  windows_ = archive.count("windows");
  window_ = {found[3], found[4], found[5], found[6], {}, {}};
  phase_ = found[7], error_ = found[8];
  const auto size = static_cast<std::size_t>(model_.num_dofs());
  const auto vector = [&](const char* name) {
    const auto& x = archive.numbers(name, size);
    return Vector(Eigen::Map<const Vector>(x.data(), model_.num_dofs()));
  };
  mean_ = vector("mean");
  if (archive.count("is_looked_at") == 0) return;
  window_.mean = vector("window_mean");
  window_.swing = vector("window_swing");
}

}  // namespace orthodyn
