// Which linear solver is wanted, and what it is told.
#pragma once

#include <string>
#include <utility>

namespace orthodyn {

struct SolverChoice {
  SolverChoice() = default;
  SolverChoice(std::string wanted, std::string told = "") : type(std::move(wanted)), options(std::move(told)) {}
  SolverChoice(const char* wanted) : type(wanted) {}
  bool operator==(const SolverChoice&) const = default;

  std::string type = "auto";  // a name of solver_registry() (lib/linear/solver.h)
  std::string options;        // as on a command line, of a solver that takes some
};

// As people read it: "petsc -pc_type gamg".
inline std::string shown(const SolverChoice& choice) {
  return choice.options.empty() ? choice.type : choice.type + " " + choice.options;
}

}  // namespace orthodyn
