#include "lib/linear/solver.h"

#include "lib/linear/gathered_solver.h"

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

std::unique_ptr<LinearSolver> make_linear_solver(const SolverChoice& choice, const Pattern& pattern) {
  auto solver = make_linear_solver(choice);
  if (!solver_registry().at(choice.type).shares_the_work) return prepare(std::move(solver), pattern);
  solver->analyze(pattern);
  return solver;
}

std::unique_ptr<LinearSolver> make_solver_for(const Pattern& pattern) {
  return make_linear_solver({pattern.symmetric ? "cholesky" : "klu"}, pattern);
}

}  // namespace orthodyn
