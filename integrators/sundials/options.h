// What all integrators of SUNDIALS have in common: their keys and their tolerances.
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "integrators/sundials/handles.h"
#include "lib/ode/integrator.h"

namespace orthodyn::sundials {

struct Options {
  double rtol = 1e-4;
  std::optional<double> position_scale, velocity_scale;  // m, m/s
  std::optional<double> h0, h_max;  // s
  double h_min = 0;                 // s
  long max_steps = 1'000'000;
  double nonlinear_coefficient = 0.01;
  int max_newton_iterations = 6;
  std::string linear_solver = "cholmod";
  bool gauss_newton = false;

  // These keys, in a Spec of a struct derived from this one.
  template <class T>
  static Spec<T> spec_for();
};

using Decisions = std::vector<std::pair<std::string, std::string>>;

// How an options struct was completed for one model.
struct Settings {
  Options options;
  Scales scales;
  bool full;            // klu_full
  Decisions decisions;  // what the input left open

  TangentKind tangent() const {
    return options.gauss_newton ? TangentKind::gauss_newton : TangentKind::exact;
  }

  static Settings complete(const Options& options, const Task& task);

  // Block weights: 1/(rtol * position) for q, 1/(rtol * velocity) for v. Relative tolerances on
  // positions would depend on the frame.
  void set_weights(N_Vector weights) const;
};

// The names that linear_solver takes.
std::vector<std::string> linear_solver_names();
void check_options(const Options& options, const Config& config);

template <class T>
Spec<T> Options::spec_for() {
  using O = Options;
  return Spec<T>()
      .key("rtol", &O::rtol, "Local error allowed per step, relative to the scales.", {.range = {0, 1, true, true}})
      .key("position_scale", &O::position_scale, "Size of motion; default from the scene.",
           {.unit = "m", .range = kPositive})
      .key("velocity_scale", &O::velocity_scale, "Size of velocities; default from the scene.",
           {.unit = "m/s", .range = kPositive})
      .key("h0", &O::h0, "First step; default estimated.", {.unit = "s", .range = kPositive})
      .key("h_min", &O::h_min, "Smallest step.", {.unit = "s", .range = kNonNegative})
      .key("h_max", &O::h_max, "Largest step; default unlimited.", {.unit = "s", .range = kPositive})
      .key("max_steps", &O::max_steps, "Steps after which the run is given up.", {.range = {1}})
      .key("nonlinear_coefficient", &O::nonlinear_coefficient,
           "Newton stops at this fraction of the error test.", {.range = {0, 1, true, false}})
      .key("max_newton_iterations", &O::max_newton_iterations, "Newton iterations per step.", {.range = {1, 50}})
      .key("linear_solver", &O::linear_solver, "One of `orthodyn list solvers`.")
      .key("gauss_newton", &O::gauss_newton,
           "Use the positive semidefinite Gauss-Newton part of the tangent from the start.")
      .check([](const T& options, const Config& config) { check_options(options, config); });
}

}  // namespace orthodyn::sundials
