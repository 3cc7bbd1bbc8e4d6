#include "lib/linear/solver.h"

namespace orthodyn {

std::map<std::string, SolverKind>& solver_registry() {
  static std::map<std::string, SolverKind> kinds;
  return kinds;
}

}  // namespace orthodyn
