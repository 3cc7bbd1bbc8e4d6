#include "integrators/solver_options.h"

#include <algorithm>

#include "lib/core/spelling.h"
#include "lib/linear/solver.h"

namespace orthodyn {

namespace {

struct SolverSection {
  std::string type, options;
  static const Spec<SolverSection>& spec() {
    static const auto s =
        Spec<SolverSection>()
            .key("type", &SolverSection::type, "One of `orthodyn list solvers`.", {.required = true})
            .key("options", &SolverSection::options,
                 "Options as on a command line: -ksp_type cg. For PETSc those that choose a method and its parameters; "
                 "put views and monitors in the environment variable PETSC_OPTIONS.");
    return s;
  }
};

}  // namespace

ValueSchema Value<SolverChoice>::schema() {
  return {.kind = ValueSchema::Kind::either, .items = {Value<std::string>::schema(), Value<SolverSection>::schema()}};
}

SolverChoice Value<SolverChoice>::read(const Config& c, const Rule& r) {
  if (!c.is_map()) return Value<std::string>::read(c, r);
  const auto section = SolverSection::spec().read(c);
  return {section.type, section.options};
}

std::vector<std::string> linear_solver_names(SolverPaths paths) {
  std::vector<std::string> names;
  for (const auto& [name, kind] : solver_registry())
    if (kind.make || paths == SolverPaths::all) names.push_back(name);
  return names;
}

void require_linear_solver(const SolverChoice& choice, SolverPaths paths, const Config& section) {
  const auto names = linear_solver_names(paths);
  const auto& name = choice.type;
  const Config given = section.at("linear_solver");
  const Config place = given.is_map() ? given.at("type") : given;
  const auto& all = solver_registry();
  if (std::find(names.begin(), names.end(), name) == names.end()) {
    if (all.contains(name))
      place.fail("'" + name + "' is for SUNDIALS' integrators only; this integrator takes one of " + join(names));
    place.fail(expected_one_of(names, name), InputFault::form);
  }
  const SolverKind& kind = all.at(name);
  if (!kind.unavailable.empty()) place.fail(kind.unavailable);
  if (choice.options.empty()) return;
  if (!kind.takes_options) given.at("options").fail("'" + name + "' takes no options; remove them");
  try {
    kind.make(choice.options);
  } catch (const ConfigError& e) {
    given.at("options").fail(e.message());
  }
}

}  // namespace orthodyn
