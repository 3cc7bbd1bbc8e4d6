// ARKODE's additive Runge-Kutta methods (Kennedy & Carpenter 2003, 2019). An explicit table integrates some parts of
// the force; an implicit table with the same weights integrates the other parts and q' = v.
//
//   (q, v)' = (0, M^-1 f_explicit) + (v, M^-1 f_implicit)
#include <fmt/format.h>

#include <algorithm>

#include "integrators/arkode/ark_step.h"
#include "integrators/arkode/tables.h"
#include "integrators/fixed_step.h"
#include "lib/core/spelling.h"

namespace orthodyn::sundials {
namespace {

bool contains(const std::vector<std::string>& names, const std::string& name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

void refuse_unknown(const std::vector<std::string>& names, const std::vector<std::string>& parts) {
  for (const auto& name : names) {
    if (contains(parts, name)) continue;
    throw ConfigError(fmt::format("explicit: the force has no part '{}'{}; its parts: {}", name,
                                  did_you_mean(name, parts), join(parts)));
  }
}

// Throws ConfigError (the caller adds file and line) if a name is unknown, if the model's force has no parts,
// or if either sum would be empty. `model` must outlive the result.
SplitForce split_force(const Model& model, const std::vector<std::string>& explicit_names) {
  const auto parts = model.force_parts();
  if (parts.empty()) throw ConfigError("the model's force is not divided into parts; use arkode_dirk or arkode_erk");
  refuse_unknown(explicit_names, parts);
  std::vector<std::string> chosen, others;
  for (const auto& part : parts) (contains(explicit_names, part) ? chosen : others).push_back(part);
  if (chosen.empty())
    throw ConfigError(
        "explicit: names no part of the force, so every part is implicit: use arkode_dirk, or name some of " +
        join(parts));
  if (others.empty())
    throw ConfigError("explicit: names every part of the force (" + join(parts) +
                      "): use arkode_erk, or leave the stiff parts out");
  return {model.only(chosen), model.only(others)};
}

class ArkodeImexChoice : public SettableChoice<ArkodeImexChoice>, public Options, public FixedStep {
 public:
  static const Spec<ArkodeImexChoice>& spec() {
    using C = ArkodeImexChoice;
    static const auto s = FixedStep::add_to(
        Options::spec_for<C>()
            .key("explicit", &C::explicit_parts,
                 "Names of the parts of the force to treat explicitly (gravity, traction on x1, elasticity of region "
                 "soft, mass damping, ...); the others are implicit. Give at least one name.")
            .key("table", &C::table, "The pair of tables: name, stages, order of the error estimate, order."),
        "Fixed step instead of error control; rtol then applies only to Newton's method.");
    return s;
  }
  static MethodFacts facts() {
    return method_facts("3-5, by `table`", "L-stable in the implicit parts, conditional in the explicit ones",
                        "linear invariants (momentum)",
                        "Kennedy & Carpenter, Appl. Numer. Math. 44, 2003, and 136, 2019");
  }
  bool runs_on_ranks() const override { return true; }
  std::unique_ptr<Integrator> make_for(const Model& model, const Task& task) const override {
    const Scales sizes = scales(task);
    ArkMethod method{.name = "arkode_imex", .step = step, .split = split_force(model, explicit_parts)};
    const auto pair = pair_of(table);
    method.explicit_table = with_end_stage(*Tableau(ARKodeButcherTable_LoadERK(pair.explicit_part)));
    method.implicit_table = with_end_stage(*Tableau(ARKodeButcherTable_LoadDIRK(pair.implicit_part)));
    return make_ark_step(model, std::move(method), *this, sizes);
  }

  AdditiveTable table = AdditiveTable::ark436;
  std::vector<std::string> explicit_parts;
};

const bool arkode_imex_registered = Registry<IntegratorChoice>::add<ArkodeImexChoice>(
    "arkode_imex",
    "ARKODE: additive Runge-Kutta methods of order 3-5, explicit in the parts of the force that `explicit` names.");

}  // namespace
}  // namespace orthodyn::sundials
