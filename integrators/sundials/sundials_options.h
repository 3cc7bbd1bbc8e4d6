// The keys that all implicit integrators of SUNDIALS share.
#pragma once

#include "integrators/error_control.h"
#include "integrators/solver_options.h"

namespace orthodyn::sundials {

struct Options : ErrorControl, NewtonLimits, SolverOptions {
  bool is_full() const { return linear_solver.type == "klu_full"; }

  // Spec with these keys for a struct derived from this one.
  template <class T>
  static Spec<T> spec_for();
};

template <class T>
Spec<T> Options::spec_for() {
  auto spec = ErrorControl::spec_for<T>();
  NewtonLimits::add_to(spec, "the error test", "step");
  SolverOptions::add_to(spec, SolverPaths::all);
  return spec;
}

}  // namespace orthodyn::sundials
