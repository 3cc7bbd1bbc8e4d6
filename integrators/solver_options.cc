#include "integrators/solver_options.h"

#include <algorithm>

#include "lib/core/words.h"
#include "lib/linear/solver.h"

namespace orthodyn {

std::vector<std::string> linear_solver_names(SolverPaths paths) {
  std::vector<std::string> names;
  for (const auto& [name, kind] : solver_registry())
    if (kind.make || paths == SolverPaths::all) names.push_back(name);
  return names;
}

void require_linear_solver(const std::string& name, SolverPaths paths, const Config& section) {
  const auto names = linear_solver_names(paths);
  if (std::find(names.begin(), names.end(), name) != names.end()) return;
  const Config given = section.at("linear_solver");
  if (solver_registry().contains(name))
    given.fail("'" + name + "' is SUNDIALS' own; this integrator takes one of " + join(names));
  given.fail(expected_one_of(names, name), InputFault::form);
}

}  // namespace orthodyn
