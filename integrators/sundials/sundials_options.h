// What all integrators of SUNDIALS have in common: their keys and their tolerances.
#pragma once

#include "integrators/error_control.h"
#include "integrators/solver_options.h"
#include "integrators/sundials/handles.h"

namespace orthodyn::sundials {

struct Options : ErrorControl, NewtonLimits, SolverOptions {
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

  static Settings complete(const Options& options, const Task& task);
  // Of a method that solves with no matrix.
  static Settings complete_explicit(const ErrorControl& control, const Task& task);

  // Block weights: 1/(rtol * position) for q, 1/(rtol * velocity) for v. Relative tolerances on
  // positions would depend on the frame.
  void set_weights(N_Vector weights) const;
};

template <class T>
Spec<T> Options::spec_for() {
  auto spec = ErrorControl::spec_for<T>();
  NewtonLimits::add_to(spec, "the error test", "step");
  SolverOptions::add_to(spec, SolverPaths::all);
  return spec;
}

}  // namespace orthodyn::sundials
