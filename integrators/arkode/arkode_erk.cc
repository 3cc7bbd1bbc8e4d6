// ARKODE's explicit Runge-Kutta methods (Reynolds et al. 2023; tables of Dormand & Prince 1980 and others):
// one-step, adaptive or with a fixed step, no matrix. A consistent mass costs a solve per force.
#include "integrators/arkode/ark_step.h"
#include "integrators/arkode/tables.h"
#include "integrators/critical_step.h"
#include "integrators/fixed_step.h"

namespace orthodyn::sundials {
namespace {

// Upper bound of the stable step, relative to the leapfrog's critical step 2/omega. Without damping, the longest stable
// step is 1/omega to 4/omega, depending on the table. With damping (real axis) it is longer.
constexpr double kReach = 4;

class ArkodeErkChoice : public SettableChoice<ArkodeErkChoice>, public ErrorControl, public FixedStep {
 public:
  static const Spec<ArkodeErkChoice>& spec() {
    using C = ArkodeErkChoice;
    static const auto s =
        FixedStep::add_to(
            ErrorControl::spec_for<C>().key(
                "table", &C::table,
                "The method: name, stages, order of the error estimate, order. KNOTH_WOLKE_3_3 has no estimate."),
            "Fixed step instead of error control; its stability is not checked.")
            .check([](const C& options, const Config& config) {
              if (options.table == ARKODE_KNOTH_WOLKE_3_3 && !options.step)
                config.at("table").fail(
                    "KNOTH_WOLKE_3_3 has no error estimate; give integrator.step, or another table");
            });
    return s;
  }
  static MethodFacts facts() {
    return method_facts(
        "2-8, by `table`",
        "conditional: the step stays below about 1 to 4 over the highest frequency, found by the error test",
        "linear invariants (momentum)",
        "Reynolds et al., ACM TOMS 49, 2023; Dormand & Prince, J. Comput. Appl. Math. 6, 1980");
  }
  bool runs_on_ranks() const override { return true; }
  InternalSupport internal_support() const override { return InternalSupport::own; }
  std::unique_ptr<Integrator> make_for(const Model& model, const Task& task) const override {
    if (!step) refuse_too_many_steps("arkode_erk", model, task, kReach, max_steps);
    ArkMethod method{.name = "arkode_erk", .step = step};
    method.explicit_table = ending_in_a_stage(Tableau(ARKodeButcherTable_LoadERK(table)));
    return make_ark_step(model, std::move(method), Options{*this, {}, {}}, scales(task));
  }

  ARKODE_ERKTableID table = ARKODE_DORMAND_PRINCE_7_4_5;
};

const bool arkode_erk_registered = Registry<IntegratorChoice>::add<ArkodeErkChoice>(
    "arkode_erk", "ARKODE: explicit Runge-Kutta methods of order 2-8, adaptive or with a fixed step.");

}  // namespace
}  // namespace orthodyn::sundials
