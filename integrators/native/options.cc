#include "integrators/native/options.h"

#include "lib/linear/solver.h"

namespace orthodyn {

void check_linear_solver(const LinearOptions& options, const Config& config) {
  std::vector<std::string> names;
  for (const auto& [name, kind] : solver_registry())
    if (kind.make) names.push_back(name);
  if (std::find(names.begin(), names.end(), options.linear_solver) != names.end()) return;
  if (solver_registry().contains(options.linear_solver))
    config.at("linear_solver")
        .fail("'" + options.linear_solver + "' is SUNDIALS' own; this integrator takes one of " + join(names));
  const auto near = nearest_name(options.linear_solver, names);
  config.at("linear_solver")
      .fail("expected one of " + join(names) + ", found '" + options.linear_solver + "'" +
            (near.empty() ? "" : "; did you mean '" + near + "'?"));
}

}  // namespace orthodyn
