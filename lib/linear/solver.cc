#include "lib/linear/solver.h"

namespace orthodyn {

std::map<std::string, SolverKind>& solver_registry() {
  static std::map<std::string, SolverKind> kinds;
  return kinds;
}

std::unique_ptr<LinearSolver> make_linear_solver(const SolverChoice& choice) {
  const SolverKind& kind = solver_registry().at(choice.type);
  if (!kind.unavailable.empty()) throw ConfigError("linear solver '" + choice.type + "': " + kind.unavailable);
  return kind.make(choice.options);
}

std::unique_ptr<LinearSolver> make_solver_for(const Pattern& pattern) {
  if (pattern.share) throw RunError("an analysis that factors a matrix does not run on several ranks");
  auto solver = make_linear_solver(pattern.symmetric ? "cholmod" : "klu");
  solver->analyze(pattern);
  return solver;
}

}  // namespace orthodyn
