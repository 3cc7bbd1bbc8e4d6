// The choice of a linear solver and its options.
#pragma once

#include <string>
#include <utility>

namespace orthodyn {

struct SolverChoice {
  SolverChoice() = default;
  SolverChoice(std::string name, std::string arguments = "") : type(std::move(name)), options(std::move(arguments)) {}
  SolverChoice(const char* name) : type(name) {}
  bool operator==(const SolverChoice&) const = default;

  std::string type = "auto";  // a name of solver_registry() (lib/linear/solver.h)
  std::string options;        // as on a command line; only for solvers that take options
};

// For messages: "petsc -pc_type gamg".
inline std::string shown(const SolverChoice& choice) {
  return choice.options.empty() ? choice.type : choice.type + " " + choice.options;
}

}  // namespace orthodyn
