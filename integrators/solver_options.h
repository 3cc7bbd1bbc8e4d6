// Keys of methods that solve linear systems, and of Newton's method: the same for our own methods and for SUNDIALS'.
#pragma once

#include <string>
#include <vector>

#include "lib/config/spec.h"
#include "lib/core/solver_choice.h"
#include "lib/core/types.h"

namespace orthodyn {

// `reduced`: solvers of the n x n matrix w_m M + w_d D + w_k K. `all`: also those that factor the full 2n x 2n system
// ("klu_full"), which not every integrator can use.
enum class SolverPaths { reduced, all };

// A name, or a section with the name as `type`.
template <>
struct Value<SolverChoice> {
  static ValueSchema schema();
  static SolverChoice read(const Config& c, const Rule& r);
  static std::string yaml(const SolverChoice& x) { return x.options.empty() ? x.type : ""; }
};

std::vector<std::string> linear_solver_names(SolverPaths paths);

// Throws ConfigError at section.linear_solver unless it is one of them that this build can make, with options that it
// takes.
void require_linear_solver(const SolverChoice& choice, SolverPaths paths, const Config& section);

// Adds the key `linear_solver` and its check to the Spec of a struct that has this member.
template <class T>
Spec<T>& add_linear_solver(Spec<T>& spec, SolverPaths paths) {
  const bool all = paths == SolverPaths::all;
  return spec
      .key("linear_solver", &T::linear_solver,
           std::string("One of `orthodyn list solvers`") + (all ? "." : ", but for klu_full.") +
               " `{type: petsc, options: \"...\"}` passes options on to it.")
      .check([paths](const T& options, const Config& config) {
        require_linear_solver(options.linear_solver, paths, config);
      });
}

// How the linear systems of an implicit method are made and solved.
struct SolverOptions {
  SolverChoice linear_solver;
  bool gauss_newton = false;

  TangentKind tangent() const { return gauss_newton ? TangentKind::gauss_newton : TangentKind::exact; }

  // These keys, in the Spec of a struct derived from this one.
  template <class T>
  static Spec<T>& add_to(Spec<T>& spec, SolverPaths paths) {
    return add_linear_solver(spec, paths)
        .key("gauss_newton", &SolverOptions::gauss_newton,
             "Use the positive semidefinite Gauss-Newton part of the tangent from the start.");
  }
};

// When Newton's method stops.
struct NewtonLimits {
  double nonlinear_coefficient = 1e-3;
  int max_newton_iterations = 6;

  // These keys, in the Spec of a struct derived from this one: what nonlinear_coefficient is a fraction of, and what
  // the iterations are for, in words.
  template <class T>
  static Spec<T>& add_to(Spec<T>& spec, const std::string& fraction_of, const std::string& unit_of_work) {
    return spec
        .key("nonlinear_coefficient", &NewtonLimits::nonlinear_coefficient,
             "Newton stops at this fraction of " + fraction_of + ".", {.range = {0, 1, true, false}})
        .key("max_newton_iterations", &NewtonLimits::max_newton_iterations,
             "Newton iterations per " + unit_of_work + ".", {.range = {1, 50}});
  }
};

}  // namespace orthodyn
