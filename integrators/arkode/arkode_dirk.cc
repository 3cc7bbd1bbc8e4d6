// ARKODE's diagonally implicit Runge-Kutta methods (Reynolds et al. 2023; tables of Kennedy & Carpenter
// 2016 and others): one-step, adaptive or with a fixed step, modified Newton.
#include "integrators/arkode/ark_step.h"
#include "integrators/arkode/tableau.h"
#include "integrators/arkode/tables.h"
#include "integrators/fixed_step.h"

namespace orthodyn::sundials {
namespace {

struct DirkOptions : Options, FixedStep {
  ARKODE_DIRKTableID table = ARKODE_ESDIRK547L2SA2_7_4_5;
};

class ArkodeDirk : public ArkStep {
 public:
  ArkodeDirk(const Model& model, const Settings& settings, const DirkOptions& options)
      : ArkodeDirk(model, settings, options, Tableau(ARKodeButcherTable_LoadDIRK(options.table))) {}

 private:
  ArkodeDirk(const Model& model, const Settings& settings, const DirkOptions& options, Tableau tableau)
      : ArkStep("arkode_dirk", model, settings, options.step, {nullptr, right_hand_side}, tableau->q),
        stiffly_accurate_(ends_in_a_stage(*tableau)),
        tableau_(stiffly_accurate_ ? std::move(tableau) : with_end_stage(*tableau)),
        last_acceleration_(model.num_dofs()) {}

  void choose_method() override {
    require(ARKStepSetTables(memory(), tableau_->q, tableau_->p, tableau_.get(), nullptr));
    attach_newton();
  }

  void end_acceleration(VectorRef a) override {
    if (stiffly_accurate_) a = stage_acceleration();
    else a = last_acceleration_;
  }

  static int right_hand_side(sunrealtype t, N_Vector y, N_Vector y_dot, void* user) {
    auto& me = static_cast<ArkodeDirk&>(*static_cast<ArkStep*>(user));
    const auto take_end = [&] {
      positions(y_dot) = me.end().v;
      velocities(y_dot) = me.end().a;
    };
    return me.known_or_evaluated(t, y, take_end, [&] {
      const int flag = me.evaluate(t, y, y_dot);
      if (!me.stiffly_accurate_) me.last_acceleration_ = velocities(y_dot);
      return flag;
    });
  }

  bool stiffly_accurate_;
  Tableau tableau_;
  Vector last_acceleration_;  // of the stage that is the step's end, unless stiffly accurate
};

class ArkodeDirkChoice : public SettableChoice<ArkodeDirkChoice>, public DirkOptions {
 public:
  static const Spec<ArkodeDirkChoice>& spec() {
    static const auto s = [] {
      auto spec = Options::spec_for<ArkodeDirkChoice>().key(
          "table", &ArkodeDirkChoice::table, "The method: name, stages, order of the error estimate, order.");
      FixedStep::add_to(spec, "Fixed step, instead of error control; rtol then applies to Newton's method only.");
      return spec;
    }();
    return s;
  }
  static MethodFacts facts() {
    return method_facts(
        "2-5, by `table`", "L-stable, stiffly accurate; BILLINGTON_3_3_2 L-stable, SDIRK_2_1_2 A-stable, R(inf) = -1/2",
        "linear invariants (momentum)", "Reynolds et al., ACM TOMS 49, 2023; Kennedy & Carpenter, NASA TM-2016-219173");
  }
  bool runs_on_ranks() const override { return true; }
  std::unique_ptr<Integrator> make(const Model& model, const Task& task) const override {
    return std::make_unique<ArkodeDirk>(model, Settings::complete(*this, task), *this);
  }
};

const bool arkode_dirk_registered = Registry<IntegratorChoice>::add<ArkodeDirkChoice>(
    "arkode_dirk", "ARKODE: diagonally implicit Runge-Kutta methods of order 2-5, adaptive or with a fixed step.");

}  // namespace
}  // namespace orthodyn::sundials
