// Keys of linear solvers and of Newton's method, shared by the native methods and those of SUNDIALS.
#pragma once

#include <string>
#include <vector>

#include "lib/config/spec.h"
#include "lib/core/solver_choice.h"
#include "lib/core/types.h"

namespace orthodyn {

// The linear solvers that an integrator accepts. reduced: those of the n x n matrix w_m M + w_d D + w_k K. all: also
// "klu_full", which factors the 2n x 2n system; only integrators of SUNDIALS accept it.
enum class SolverPaths { reduced, all };

// In the input, a solver is a name, or a section with the name as `type`.
template <>
struct Value<SolverChoice> {
  static ValueSchema schema();
  static SolverChoice read(const Config& c, const Rule& r);
  static std::string yaml(const SolverChoice& x) { return x.options.empty() ? x.type : ""; }
};

std::vector<std::string> linear_solver_names(SolverPaths paths);

// Throws ConfigError at section.linear_solver if the solver is not in linear_solver_names(paths), is missing in this
// build, or does not accept its options.
void require_linear_solver(const SolverChoice& choice, SolverPaths paths, const Config& section);

// Adds the key `linear_solver` and its check to the Spec of a struct that has this member.
template <class T>
Spec<T>& add_linear_solver(Spec<T>& spec, SolverPaths paths) {
  const bool all = paths == SolverPaths::all;
  return spec
      .key("linear_solver", &T::linear_solver,
           std::string("One of `orthodyn list solvers`") + (all ? "." : ", except klu_full.") +
               " `{type: petsc, options: \"...\"}` passes options to PETSc.")
      .check([paths](const T& options, const Config& config) {
        require_linear_solver(options.linear_solver, paths, config);
      });
}

// Tangent and linear solver of an implicit method.
struct SolverOptions {
  SolverChoice linear_solver;
  bool gauss_newton = false;

  TangentKind tangent() const { return gauss_newton ? TangentKind::gauss_newton : TangentKind::exact; }

  // Adds these keys to the Spec of a struct derived from this one.
  template <class T>
  static Spec<T>& add_to(Spec<T>& spec, SolverPaths paths) {
    return add_linear_solver(spec, paths)
        .key("gauss_newton", &SolverOptions::gauss_newton,
             "Use the positive semidefinite Gauss-Newton part of the tangent from the start.");
  }
};

// The limits at which Newton's method stops.
struct NewtonLimits {
  double nonlinear_coefficient = 1e-3;
  int max_newton_iterations = 6;

  // Adds these keys to the Spec of a struct derived from this one. `fraction_of`: the tolerance that
  // nonlinear_coefficient multiplies ("rtol"). `unit_of_work`: what max_newton_iterations applies to ("step", "stage").
  // Both are named in the keys' sentences.
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
