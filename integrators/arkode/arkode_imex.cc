// ARKODE's additive Runge-Kutta methods (Kennedy & Carpenter 2003, 2019): some parts of the force by an
// explicit table, the others, with q' = v, by an implicit one that shares its weights.
//
//   (q, v)' = (0, M^-1 f_explicit) + (v, M^-1 f_implicit)
#include "integrators/arkode/ark_step.h"
#include "integrators/arkode/tableau.h"
#include "integrators/arkode/tables.h"
#include "integrators/fixed_step.h"
#include "integrators/split_force.h"

namespace orthodyn::sundials {
namespace {

struct ImexOptions : Options, FixedStep {
  AdditiveTable table = AdditiveTable::ark436;
  std::vector<std::string> explicit_parts;
};

// Declared as a base so that it is there before the integrator that works on it.
struct Split {
  SplitForce split;
};

class ArkodeImex : private Split, public ArkStep {
 public:
  // Of the models only the implicit one gives K and D.
  ArkodeImex(SplitForce parts, const Settings& settings, const ImexOptions& options)
      : ArkodeImex(std::move(parts), settings, options, pair_of(options.table)) {}

 private:
  ArkodeImex(SplitForce parts, const Settings& settings, const ImexOptions& options, const AdditivePair& pair)
      : ArkodeImex(std::move(parts), settings, options,
                   with_end_stage(*Tableau(ARKodeButcherTable_LoadERK(pair.explicit_part))),
                   with_end_stage(*Tableau(ARKodeButcherTable_LoadDIRK(pair.implicit_part)))) {}

  ArkodeImex(SplitForce parts, const Settings& settings, const ImexOptions& options, Tableau explicit_tableau,
             Tableau implicit_tableau)
      : Split{std::move(parts)},
        ArkStep("arkode_imex", *split.implicit_part, settings, options.step, {explicit_force, implicit_force},
                implicit_tableau->q),
        explicit_tableau_(std::move(explicit_tableau)),
        implicit_tableau_(std::move(implicit_tableau)),
        last_(model_.num_dofs()),
        end_explicit_(model_.num_dofs()) {}

  void choose_method() override {
    require(ARKStepSetTables(memory(), implicit_tableau_->q, implicit_tableau_->p, implicit_tableau_.get(),
                             explicit_tableau_.get()));
    attach_newton();
  }

  void begin_acceleration(double t, VectorRef a) override {
    initial_acceleration(*split.explicit_part, t, end_explicit_);
    initial_acceleration(*split.implicit_part, t, a);
    a += end_explicit_;
  }

  // The implicit force of the last, explicit stage is evaluated before the explicit one.
  void end_acceleration(VectorRef a) override {
    end_explicit_ = last_.explicit_part;
    a = last_.explicit_part + last_.implicit_part;
  }

  static ArkodeImex& self(void* user) { return static_cast<ArkodeImex&>(*static_cast<ArkStep*>(user)); }

  static int explicit_force(sunrealtype t, N_Vector y, N_Vector y_dot, void* user) {
    auto& me = self(user);
    positions(y_dot).setZero();
    return me.known_or_evaluated(
        t, y, [&] { velocities(y_dot) = me.end_explicit_; },
        [&] {
          const int flag = me.evaluate_acceleration(*me.split.explicit_part, t, y, velocities(y_dot));
          me.last_.explicit_part = velocities(y_dot);
          return flag;
        });
  }

  static int implicit_force(sunrealtype t, N_Vector y, N_Vector y_dot, void* user) {
    auto& me = self(user);
    positions(y_dot) = velocities(y);
    return me.known_or_evaluated(
        t, y, [&] { velocities(y_dot) = me.end().a - me.end_explicit_; },
        [&] {
          const int flag = me.evaluate_acceleration(*me.split.implicit_part, t, y, velocities(y_dot));
          me.last_.implicit_part = velocities(y_dot);
          return flag;
        });
  }

  // M^-1 f of the stage evaluated last, which after a step is its end.
  struct Accelerations {
    explicit Accelerations(int n) : explicit_part(n), implicit_part(n) {}
    Vector explicit_part, implicit_part;
  };

  Tableau explicit_tableau_, implicit_tableau_;
  Accelerations last_;
  Vector end_explicit_;  // the explicit share of the acceleration at the last step's end
};

class ArkodeImexChoice : public SettableChoice<ArkodeImexChoice>, public ImexOptions {
 public:
  static const Spec<ArkodeImexChoice>& spec() {
    using C = ArkodeImexChoice;
    static const auto s = [] {
      auto spec = Options::spec_for<C>()
                      .key("explicit", &C::explicit_parts,
                           "Parts of the force that are treated explicitly, by name (gravity, traction on x1, "
                           "elasticity of region soft, mass damping, ...); the others are implicit. At least one.")
                      .key("table", &C::table, "The pair of tables: name, stages, order of the error estimate, order.");
      FixedStep::add_to(spec, "Fixed step, instead of error control; rtol then applies to Newton's method only.");
      return spec;
    }();
    return s;
  }
  static MethodFacts facts() {
    return method_facts("3-5, by `table`", "L-stable in the implicit parts, conditional in the explicit ones",
                        "linear invariants (momentum)",
                        "Kennedy & Carpenter, Appl. Numer. Math. 44, 2003, and 136, 2019");
  }
  bool runs_on_ranks() const override { return true; }
  std::unique_ptr<Integrator> make(const Model& model, const Task& task) const override {
    return std::make_unique<ArkodeImex>(split_force(model, explicit_parts), Settings::complete(*this, task), *this);
  }
};

const bool arkode_imex_registered = Registry<IntegratorChoice>::add<ArkodeImexChoice>(
    "arkode_imex",
    "ARKODE: additive Runge-Kutta methods of order 3-5, explicit in the parts of the force that "
    "`explicit` names.");

}  // namespace
}  // namespace orthodyn::sundials
