#include "tests/contract/methods.h"

namespace orthodyn {

const std::map<std::string, TestedMethod>& tested_methods() {
  static const std::map<std::string, TestedMethod> all = {
      {"arkode_dirk", {{{2, ", table: TRBDF2_3_3_2"}, {5, ", table: ESDIRK547L2SA_7_4_5"}}, true, true}},
      {"arkode_erk", {{{2, ", table: HEUN_EULER_2_1_2"}, {5, ", table: DORMAND_PRINCE_7_4_5"}}, false}},
      {"arkode_imex",
       {{{3, ", table: ARK324L2SA_4_2_3"}, {5, ", table: ARK548L2SA_8_4_5"}},
        false,
        false,
        false,
        ", explicit: [gravity]"}},
      {"auto", {.variants = {{5}}, .chooses = true}},
      {"backward_euler", {{{1}}, true, false, false, "", true}},
      {"bathe", {{{2}}, true, false, false, "", true}},
      {"central_differences", {{{2}}, false}},
      {"cvode_adams", {{{2, ", max_order: 2"}, {5, ", max_order: 5"}}, false, true}},
      {"cvode_bdf", {{{2, ", max_order: 2"}, {5, ", max_order: 5"}}, true, true}},
      {"energy_momentum", {.variants = {{2}}, .stiff = false, .has_one_estimator = true, .keeps_energy = true}},
      {"exponential_rosenbrock", {{{3}}, true, false, true}},
      {"generalized_alpha", {{{2}}, true, false, false, "", true}},
      {"hht_alpha", {{{2}}, true, false, false, "", true}},
      {"ida_bdf", {{{2, ", max_order: 2"}, {5, ", max_order: 5"}}, true, true}},
      {"modal", {.variants = {{5}}, .exact_if_linear = true, .needs = ", modes: 1000", .linear_only = true}},
      {"newmark", {{{2}, {1, ", beta: 0.5, gamma: 0.7"}}, true, false, false, "", true}},
      {"rosenbrock", {{{3}}}},
      {"sdirk", {{{2, ", order: 2"}, {3, ", order: 3"}, {4, ", order: 4"}}}},
      {"semi_implicit_euler", {{{1}}, true, false, false, "", true}},
      {"tr_bdf2", {{{2}}, true, false, false, "", true}},
  };
  return all;
}

const TestedMethod& tested(const std::string& integrator) {
  const auto found = tested_methods().find(integrator);
  if (found == tested_methods().end()) throw std::logic_error("tests/contract/methods.h has no " + integrator);
  return found->second;
}

bool has_key(const std::string& integrator, const std::string& key) {
  for (const auto& k : Registry<IntegratorChoice>::entries().at(integrator).keys)
    if (k.name == key) return true;
  return false;
}

bool controls_its_error(const std::string& integrator) { return has_key(integrator, "rtol"); }

bool solves_systems(const std::string& integrator) { return has_key(integrator, "linear_solver"); }

std::vector<std::string> tried_solvers(const std::string& integrator) {
  if (!solves_systems(integrator)) return {"none"};
  const bool has_petsc = solver_registry().at("petsc").unavailable.empty();
  if (!tested(integrator).full_path) {
    std::vector<std::string> names{"cholesky", "klu"};
    // PETSc with one native method of each kind; the others solve in the same way.
    if (has_petsc && (integrator == "tr_bdf2" || integrator == "rosenbrock")) names.push_back("petsc");
    return names;
  }
  std::vector<std::string> names;
  for (const auto& [name, kind] : solver_registry())
    if (name != "auto" && (name != "petsc" || has_petsc)) names.push_back(name);  // auto is cholesky for small models
  return names;
}

}  // namespace orthodyn
