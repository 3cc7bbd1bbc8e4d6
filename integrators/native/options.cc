#include "integrators/native/options.h"

#include "lib/linear/solver.h"

namespace orthodyn {

void check_linear_solver(const std::string& given, const Config& config) {
  std::vector<std::string> names;
  for (const auto& [name, kind] : solver_registry())
    if (kind.make) names.push_back(name);
  if (std::find(names.begin(), names.end(), given) != names.end()) return;
  if (solver_registry().contains(given))
    config.at("linear_solver")
        .fail("'" + given + "' is SUNDIALS' own; this integrator takes one of " + join(names));
  const auto near = nearest_name(given, names);
  config.at("linear_solver")
      .fail("expected one of " + join(names) + ", found '" + given + "'" +
            (near.empty() ? "" : "; did you mean '" + near + "'?"));
}

}  // namespace orthodyn
