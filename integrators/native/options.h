// Keys of our own implicit methods: error control or a fixed step, a linear solver, Newton's method.
#pragma once

#include <array>
#include <string>

#include "integrators/error_control.h"
#include "integrators/fixed_step.h"
#include "integrators/linear_solver_key.h"

namespace orthodyn {

// When Newton's matrix is made anew: when convergence asks for it, at each step, at each iteration.
enum class NewtonKind { lazy, modified, full };

template <>
struct Words<NewtonKind> {
  static constexpr std::array<std::pair<NewtonKind, const char*>, 3> list{
      {{NewtonKind::lazy, "lazy"}, {NewtonKind::modified, "modified"}, {NewtonKind::full, "full"}}};
};

// Of methods that solve with A = M + w_d D + w_k K.
struct LinearOptions : ErrorControl, FixedStep {
  std::string linear_solver = "cholmod";
  bool gauss_newton = false;

  TangentKind tangent() const { return gauss_newton ? TangentKind::gauss_newton : TangentKind::exact; }

  // These keys, in a Spec of a struct derived from this one.
  template <class T>
  static Spec<T> spec_for();
};

// Of methods whose stages are found by Newton's method.
struct NewtonOptions : LinearOptions {
  NewtonKind newton = NewtonKind::lazy;
  double nonlinear_coefficient = 0.01;
  int max_newton_iterations = 6;

  template <class T>
  static Spec<T> spec_for();
};

template <class T>
Spec<T> LinearOptions::spec_for() {
  using O = LinearOptions;
  auto spec = ErrorControl::spec_for<T>();
  FixedStep::add_to(spec, "Fixed step, in place of error control.");
  spec.key("linear_solver", &O::linear_solver, "One of `orthodyn list solvers`, but for klu_full.")
      .key("gauss_newton", &O::gauss_newton,
           "Use the positive semidefinite Gauss-Newton part of the tangent from the start.")
      .check([](const T& options, const Config& config) {
        require_linear_solver(options.linear_solver, SolverPaths::reduced, config);
      });
  return spec;
}

template <class T>
Spec<T> NewtonOptions::spec_for() {
  using O = NewtonOptions;
  return LinearOptions::spec_for<T>()
      .key("newton", &O::newton,
           "When the tangent is made anew: when convergence asks for it, at each step, at each iteration.")
      .key("nonlinear_coefficient", &O::nonlinear_coefficient,
           "Newton stops at this fraction of rtol, with a fixed step too.", {.range = {0, 1, true, false}})
      .key("max_newton_iterations", &O::max_newton_iterations, "Newton iterations per stage.", {.range = {1, 50}});
}

}  // namespace orthodyn
