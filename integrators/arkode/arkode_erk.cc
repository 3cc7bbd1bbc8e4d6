// ARKODE's explicit Runge-Kutta methods (Reynolds et al. 2023; tables of Dormand & Prince 1980 and others):
// one-step, adaptive or with a fixed step, no matrix. A consistent mass costs a solve per force.
#include "integrators/arkode/ark_step.h"
#include "integrators/arkode/tableau.h"
#include "integrators/arkode/tables.h"
#include "integrators/critical_step.h"
#include "integrators/fixed_step.h"

namespace orthodyn::sundials {
namespace {

// In critical steps of the leapfrog, 2/omega. The tables end at 1/omega to 4/omega undamped, and further on the real
// axis, as with damping: no step is longer.
constexpr double kReach = 4;

struct ErkOptions : ErrorControl, FixedStep {
  ARKODE_ERKTableID table = ARKODE_DORMAND_PRINCE_7_4_5;
};

class ArkodeErk : public ArkStep {
 public:
  ArkodeErk(const Model& model, const Settings& settings, const ErkOptions& options)
      : ArkodeErk(model, settings, options, Tableau(ARKodeButcherTable_LoadERK(options.table))) {}

 private:
  ArkodeErk(const Model& model, const Settings& settings, const ErkOptions& options, Tableau tableau)
      : ArkStep("arkode_erk", model, settings, options.step, {right_hand_side, nullptr}, tableau->q),
        tableau_(ends_in_a_stage(*tableau) ? std::move(tableau) : with_end_stage(*tableau)),
        last_acceleration_(model.num_dofs()) {}

  void choose_method() override {
    require(ARKStepSetTables(memory(), tableau_->q, tableau_->p, nullptr, tableau_.get()));
  }

  void end_acceleration(VectorRef a) override { a = last_acceleration_; }

  static int right_hand_side(sunrealtype t, N_Vector y, N_Vector y_dot, void* user) {
    auto& me = static_cast<ArkodeErk&>(*static_cast<ArkStep*>(user));
    const auto take_end = [&] {
      positions(y_dot) = me.end().v;
      velocities(y_dot) = me.end().a;
    };
    return me.known_or_evaluated(t, y, take_end, [&] {
      const int flag = me.evaluate(t, y, y_dot);
      me.last_acceleration_ = velocities(y_dot);
      return flag;
    });
  }

  Tableau tableau_;
  Vector last_acceleration_;  // after a step that of its end
};

class ArkodeErkChoice : public SettableChoice<ArkodeErkChoice>, public ErkOptions {
 public:
  static const Spec<ArkodeErkChoice>& spec() {
    static const auto s = [] {
      auto spec = ErrorControl::spec_for<ArkodeErkChoice>().key(
          "table", &ArkodeErkChoice::table,
          "The method: name, stages, order of the error estimate, order. KNOTH_WOLKE_3_3 has no estimate.");
      FixedStep::add_to(spec, "Fixed step, instead of error control; nothing checks its stability.");
      spec.check([](const ArkodeErkChoice& options, const Config& config) {
        if (options.table == ARKODE_KNOTH_WOLKE_3_3 && !options.step)
          config.at("table").fail("KNOTH_WOLKE_3_3 has no error estimate; give integrator.step, or another table");
      });
      return spec;
    }();
    return s;
  }
  static MethodFacts facts() {
    return method_facts("2-8, by `table`",
                        "conditional: the step stays below about 1 to 4 over the highest frequency, found by the "
                        "error test",
                        "linear invariants (momentum)",
                        "Reynolds et al., ACM TOMS 49, 2023; Dormand & Prince, J. Comput. Appl. Math. 6, 1980");
  }
  bool runs_on_ranks() const override { return true; }
  std::unique_ptr<Integrator> make(const Model& model, const Task& task) const override {
    if (!step) refuse_a_run_without_end("arkode_erk", model, task, kReach, max_steps);
    return std::make_unique<ArkodeErk>(model, Settings::complete_explicit(*this, task), *this);
  }
};

const bool arkode_erk_registered = Registry<IntegratorChoice>::add<ArkodeErkChoice>(
    "arkode_erk", "ARKODE: explicit Runge-Kutta methods of order 2-8, adaptive or with a fixed step.");

}  // namespace
}  // namespace orthodyn::sundials
