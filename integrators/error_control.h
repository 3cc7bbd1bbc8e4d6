// The keys of error control. rtol bounds the root mean square of the local errors of all positions and velocities, each
// divided by its scale (scaled_norm.h).
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "lib/config/spec.h"
#include "lib/ode/settable_choice.h"

namespace orthodyn {

using Decisions = std::vector<std::pair<std::string, std::string>>;

struct ErrorControl {
  double rtol = 1e-4;
  std::optional<double> position_scale, velocity_scale;  // m, m/s
  std::optional<double> h0, h_max;                       // s
  double h_min = 0;                                      // s
  long max_steps = 1'000'000;

  // The scales given in the input; the task estimates those that are missing.
  Scales scales(const Task& task) const;

  // Spec with these keys for a struct derived from this one.
  template <class T>
  static Spec<T> spec_for();
};

// Throws ConfigError unless h_min <= h_max and h0 <= h_max, if given.
void check_error_control(const ErrorControl& control, const Config& config);

// The scales as entries of Integrator::decisions().
Decisions scale_decisions(const Scales& scales);

template <class T>
Spec<T> ErrorControl::spec_for() {
  using C = ErrorControl;
  return Spec<T>()
      .key("rtol", &C::rtol, "Local error allowed per step, relative to the scales.",
           {.range = {1e-14, 1, false, true}})
      .key("position_scale", &C::position_scale, "Size of motion; default from the scene.",
           {.unit = "m", .range = kPositive})
      .key("velocity_scale", &C::velocity_scale, "Size of velocities; default from the scene.",
           {.unit = "m/s", .range = kPositive})
      .key("h0", &C::h0, "First step; default estimated.", {.unit = "s", .range = kPositive})
      .key("h_min", &C::h_min, "Smallest step.", {.unit = "s", .range = kNonNegative})
      .key("h_max", &C::h_max, "Largest step; default unlimited.", {.unit = "s", .range = kPositive})
      .key("max_steps", &C::max_steps, "Number of steps after which the run fails.", {.range = {1}})
      .check([](const T& control, const Config& config) { check_error_control(control, config); });
}

}  // namespace orthodyn
