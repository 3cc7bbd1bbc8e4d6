// What all integrators of SUNDIALS have in common: their keys and their tolerances.
#pragma once

#include <string>
#include <vector>

#include "integrators/error_control.h"
#include "integrators/sundials/handles.h"

namespace orthodyn::sundials {

struct Options : ErrorControl {
  double nonlinear_coefficient = 0.01;
  int max_newton_iterations = 6;
  std::string linear_solver = "cholmod";
  bool gauss_newton = false;

  // These keys, in a Spec of a struct derived from this one.
  template <class T>
  static Spec<T> spec_for();
};

// How an options struct was completed for one model.
struct Settings {
  Options options;
  Scales scales;
  bool implicit;        // some matrix has to be solved with
  bool full;            // klu_full
  Decisions decisions;  // what the input left open

  TangentKind tangent() const {
    return options.gauss_newton ? TangentKind::gauss_newton : TangentKind::exact;
  }

  static Settings complete(const Options& options, const Task& task);
  // Of a method that solves with no matrix.
  static Settings complete_explicit(const ErrorControl& control, const Task& task);

  // Block weights: 1/(rtol * position) for q, 1/(rtol * velocity) for v. Relative tolerances on
  // positions would depend on the frame.
  void set_weights(N_Vector weights) const;
};

void check_options(const Options& options, const Config& config);

template <class T>
Spec<T> Options::spec_for() {
  using O = Options;
  return ErrorControl::spec_for<T>()
      .key("nonlinear_coefficient", &O::nonlinear_coefficient,
           "Newton stops at this fraction of the error test.", {.range = {0, 1, true, false}})
      .key("max_newton_iterations", &O::max_newton_iterations, "Newton iterations per step.", {.range = {1, 50}})
      .key("linear_solver", &O::linear_solver, "One of `orthodyn list solvers`.")
      .key("gauss_newton", &O::gauss_newton,
           "Use the positive semidefinite Gauss-Newton part of the tangent from the start.")
      .check([](const T& options, const Config& config) { check_options(options, config); });
}

}  // namespace orthodyn::sundials
