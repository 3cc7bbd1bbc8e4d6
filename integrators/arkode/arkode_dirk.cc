// ARKODE's diagonally implicit Runge-Kutta methods (Reynolds et al. 2023; tables of Kennedy & Carpenter
// 2016 and others): one-step, adaptive or with a fixed step, modified Newton.
#include "integrators/arkode/ark_step.h"
#include "integrators/arkode/tables.h"
#include "integrators/fixed_step.h"

namespace orthodyn::sundials {
namespace {

class ArkodeDirkChoice : public SettableChoice<ArkodeDirkChoice>, public Options, public FixedStep {
 public:
  static const Spec<ArkodeDirkChoice>& spec() {
    static const auto s = FixedStep::add_to(
        Options::spec_for<ArkodeDirkChoice>().key("table", &ArkodeDirkChoice::table,
                                                  "The method: name, stages, order of the error estimate, order."),
        "Fixed step instead of error control; rtol then applies only to Newton's method.");
    return s;
  }
  static MethodFacts facts() {
    return method_facts(
        "2-5, by `table`", "L-stable, stiffly accurate; BILLINGTON_3_3_2 L-stable, SDIRK_2_1_2 A-stable, R(inf) = -1/2",
        "linear invariants (momentum)", "Reynolds et al., ACM TOMS 49, 2023; Kennedy & Carpenter, NASA TM-2016-219173");
  }
  bool runs_on_ranks() const override { return true; }
  InternalSupport internal_support() const override { return InternalSupport::own; }
  std::unique_ptr<Integrator> make_for(const Model& model, const Task& task) const override {
    Tableau tableau(ARKodeButcherTable_LoadDIRK(table));
    ArkMethod method{.name = "arkode_dirk", .step = step, .stiffly_accurate = ends_in_a_stage(*tableau)};
    method.implicit_table = ending_in_a_stage(std::move(tableau));
    return make_ark_step(model, std::move(method), *this, scales(task));
  }

  ARKODE_DIRKTableID table = ARKODE_ESDIRK547L2SA2_7_4_5;
};

const bool arkode_dirk_registered = Registry<IntegratorChoice>::add<ArkodeDirkChoice>(
    "arkode_dirk", "ARKODE: diagonally implicit Runge-Kutta methods of order 2-5, adaptive or with a fixed step.");

}  // namespace
}  // namespace orthodyn::sundials
