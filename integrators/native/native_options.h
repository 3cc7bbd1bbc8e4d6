// Keys of the native implicit methods: error control or a fixed step, linear solver, Newton's method.
#pragma once

#include <array>
#include <utility>

#include "integrators/error_control.h"
#include "integrators/fixed_step.h"
#include "integrators/solver_options.h"

namespace orthodyn {

// When the tangent is recomputed. lazy: when this costs less than the iterations of an old one; modified: at each step;
// full: at each iteration.
enum class NewtonKind { lazy, modified, full };

template <>
struct EnumNames<NewtonKind> {
  static constexpr std::array<std::pair<NewtonKind, const char*>, 3> list{
      {{NewtonKind::lazy, "lazy"}, {NewtonKind::modified, "modified"}, {NewtonKind::full, "full"}}};
};

// Options of methods that solve linear systems with A = M + w_d D + w_k K.
struct LinearOptions : ErrorControl, FixedStep, SolverOptions {
  // Spec with these keys for a struct derived from this one.
  template <class T>
  static Spec<T> spec_for();
};

// Options of methods that solve their stages by Newton's method.
struct NewtonOptions : LinearOptions, NewtonLimits {
  NewtonKind newton = NewtonKind::lazy;

  template <class T>
  static Spec<T> spec_for();
};

template <class T>
Spec<T> LinearOptions::spec_for() {
  auto spec = ErrorControl::spec_for<T>();
  FixedStep::add_to(spec, "Fixed step instead of error control.");
  SolverOptions::add_to(spec, SolverPaths::reduced);
  return spec;
}

template <class T>
Spec<T> NewtonOptions::spec_for() {
  auto spec =
      LinearOptions::spec_for<T>().key("newton", &NewtonOptions::newton,
                                       "When the tangent is recomputed. lazy: when this costs less than further "
                                       "iterations with the old tangent; modified: at each step; full: at each "
                                       "iteration.");
  NewtonLimits::add_to(spec, "rtol, with a fixed step too", "stage");
  return spec;
}

}  // namespace orthodyn
