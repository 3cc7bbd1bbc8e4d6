// ARKODE's diagonally implicit Runge-Kutta methods (Reynolds et al. 2023; tables of Kennedy & Carpenter
// 2016 and others): one-step, stiffly accurate, adaptive or with a fixed step, modified Newton.
#include <arkode/arkode_arkstep.h>

#include "integrators/arkode/tables.h"
#include "integrators/sundials/first_order.h"
#include "lib/ode/hermite.h"

namespace orthodyn::sundials {
namespace {

struct FreeMemory {
  void operator()(void* memory) const { ARKStepFree(&memory); }
};

struct DirkOptions : Options {
  ARKODE_DIRKTableID table = ARKODE_ESDIRK547L2SA2_7_4_5;
  std::optional<double> step;  // s
};

int order_of(ARKODE_DIRKTableID id) {
  const Owned<ARKodeButcherTable, ARKodeButcherTable_Free> table(ARKodeButcherTable_LoadDIRK(id));
  return table->q;
}

class ArkodeDirk : public FirstOrderIntegrator {
 public:
  ArkodeDirk(const Model& model, const Settings& settings, const DirkOptions& options)
      : FirstOrderIntegrator("arkode_dirk", model, settings), table_(options.table), step_(options.step),
        order_(order_of(options.table)) {}

 protected:
  void initialise(double t) override {
    begin_at(t);
    memory_.reset(ARKStepCreate(nullptr, right_hand_side, t, y(), context_));
    void* m = memory_.get();
    if (!m) throw RunError("ARKODE could not be created");
    ORTHODYN_CAPTURE_ERRORS(ARKStepSetErrHandlerFn, context_, m, &border_.library_message);
    require(ARKStepSetUserData(m, this));
    require(ARKStepSetTableNum(m, table_, ARKODE_ERK_NONE));
    require(ARKStepWFtolerances(m, [](N_Vector, N_Vector weights, void* user) {
      self(user).settings_.set_weights(weights);
      return 0;
    }));
    const auto& o = settings_.options;
    require(ARKStepSetNonlinConvCoef(m, o.nonlinear_coefficient));
    require(ARKStepSetMaxNonlinIters(m, o.max_newton_iterations));
    if (o.h0) require(ARKStepSetInitStep(m, *o.h0));
    if (o.h_max) require(ARKStepSetMaxStep(m, *o.h_max));
    if (o.h_min > 0) require(ARKStepSetMinStep(m, o.h_min));
    settings_.full ? attach_full() : attach_reduced();
    tune();
  }

  void reinitialise(double t) override {
    begin_at(t);
    require(ARKStepReInit(memory_.get(), nullptr, right_hand_side, t, y()));
  }

  int advance(double t_stop, double& t) override {
    if (step_) require(ARKStepSetFixedStep(memory_.get(), length_of_step(t_stop - t)));
    require(ARKStepSetStopTime(memory_.get(), t_stop));
    sunrealtype reached = t;  // after a failure the time of a stage
    const int flag = ARKStepEvolve(memory_.get(), t_stop, y(), &reached, ARK_ONE_STEP);
    if (flag >= 0) take_end(t = reached);
    return flag;
  }

  StepInfo last_step() const override {
    StepInfo info;
    ARKStepGetLastStep(memory_.get(), &info.h);
    info.order = order_;
    return info;
  }

  double current_step() const override {
    sunrealtype h = 0;
    ARKStepGetCurrentStep(memory_.get(), &h);
    return h;
  }

  int dense_output(double t, N_Vector out) const override {
    orthodyn::interpolate(begin_, end_, t, positions(out), velocities(out));
    return 0;
  }

  Counters counters() const override {
    Counters c;
    void* m = memory_.get();
    ARKStepGetNumSteps(m, &c.steps);
    ARKStepGetNumErrTestFails(m, &c.error_test_failures);
    ARKStepGetNumStepSolveFails(m, &c.convergence_failures);
    ARKStepGetNumNonlinSolvIters(m, &c.newton_iterations);
    return c;
  }

  Reason classify(int flag) const override {
    switch (flag) {
      case ARK_ERR_FAILURE: return Reason::error_test;
      case ARK_CONV_FAILURE:
      case ARK_LSETUP_FAIL:
      case ARK_LSOLVE_FAIL:
      case ARK_NLS_SETUP_RECVR: return Reason::newton;
      case ARK_RHSFUNC_FAIL:
      case ARK_FIRST_RHSFUNC_ERR:
      case ARK_REPTD_RHSFUNC_ERR:
      case ARK_UNREC_RHSFUNC_ERR: return Reason::force;
      case ARK_TOO_CLOSE: return Reason::step_too_small;
      default: return Reason::other;
    }
  }

  std::size_t workspace_bytes() const override {
    long reals = 0, integers = 0;
    ARKStepGetWorkSpace(memory_.get(), &reals, &integers);
    return (static_cast<std::size_t>(reals) + 3 * static_cast<std::size_t>(size())) * sizeof(sunrealtype);
  }

  bool adaptive() const override { return !step_; }

 private:
  static ArkodeDirk& self(void* user) { return *static_cast<ArkodeDirk*>(user); }

  // An explicit first stage asks for the derivative at the last step's end, which is known. A force that
  // could not be evaluated there would end the integration: no smaller step avoids it.
  static int right_hand_side(sunrealtype t, N_Vector y, N_Vector y_dot, void* user) {
    auto& me = self(user);
    const Knot& end = me.end_;
    if (t != end.t || positions(y) != end.q || velocities(y) != end.v) return me.evaluate(t, y, y_dot);
    positions(y_dot) = end.v;
    velocities(y_dot) = end.a;
    return 0;
  }

  // Figures: docs/decisions.md.
  void tune() {
    void* m = memory_.get();
    // The derivative of a stage is taken from its solution: a force evaluated there would multiply what
    // Newton left by the stiffness, and could fail after Newton has converged.
    require(ARKStepSetDeduceImplicitRhs(m, SUNTRUE));
    // Early stages are extrapolated by a high order, late ones by a low one: half the iterations of the
    // library's own choice, the last solution. Degree 3 is the highest that evaluates no force.
    require(ARKStepSetPredictorMethod(m, 2));
    require(ARKStepSetInterpolantDegree(m, 3));
    // The rate of convergence is not remembered. On a linear model it is all but zero, and Newton
    // would take one iteration for enough even after gamma has moved.
    require(ARKStepSetNonlinCRDown(m, 1));
  }

  // The last step before t_stop is what is left, without a sliver of round-off after it.
  double length_of_step(double rest) const { return rest > *step_ * (1 + 1e-6) ? *step_ : rest; }

  void begin_at(double t) {
    end_ = {t, positions(y()), velocities(y()), Vector(model_.num_dofs())};
    initial_acceleration(t, end_.a);
  }

  // The tables are stiffly accurate: the derivative of the last stage is that of the step's end.
  void take_end(double t) {
    sunrealtype at, gamma;
    N_Vector predicted, stage, stage_derivative, data;
    void* user;
    require(ARKStepGetNonlinearSystemData(memory_.get(), &at, &predicted, &stage, &stage_derivative, &gamma, &data,
                                          &user));
    std::swap(begin_, end_);
    end_.t = t;
    end_.q = positions(y());
    end_.v = velocities(y());
    end_.a = velocities(stage_derivative);
  }

  void attach_reduced() {
    make_first_order_solver([this] {
      sunrealtype gamma = 0;
      ARKStepGetCurrentGamma(memory_.get(), &gamma);
      return gamma;
    });
    require(ARKStepSetLinearSolver(memory_.get(), solver_.get(), matrix_.get()));
    require(ARKStepSetLinSysFn(memory_.get(), [](sunrealtype t, N_Vector y, N_Vector, SUNMatrix, SUNMatrix,
                                                 sunbooleantype jok, sunbooleantype* jcur, sunrealtype, void* user,
                                                 N_Vector, N_Vector, N_Vector) { return self(user).linearize_reduced(t, y, jok, jcur); }));
  }

  void attach_full() {
    make_full_solver();
    require(ARKStepSetLinearSolver(memory_.get(), solver_.get(), matrix_.get()));
    require(ARKStepSetJacFn(memory_.get(), [](sunrealtype t, N_Vector y, N_Vector, SUNMatrix J, void* user, N_Vector,
                                            N_Vector, N_Vector) { return self(user).fill_full(t, y, J); }));
  }

  ARKODE_DIRKTableID table_;
  std::optional<double> step_;
  int order_;
  Knot begin_, end_;  // of the last step
  std::unique_ptr<void, FreeMemory> memory_;
};

class ArkodeDirkChoice : public IntegratorChoice, public DirkOptions {
 public:
  static const Spec<ArkodeDirkChoice>& spec() {
    using C = ArkodeDirkChoice;
    static const auto s =
        Options::spec_for<C>()
            .key("table", &C::table, "The method: name, stages, order of the error estimate, order.")
            .key("step", &C::step, "Fixed step, in place of error control; rtol then is Newton's alone.",
                 {.unit = "s", .range = kPositive})
            .check([](const C& options, const Config& config) {
              if (!options.step) return;
              if (options.h0) config.at("h0").fail("has no meaning with a fixed step");
              if (options.h_max) config.at("h_max").fail("has no meaning with a fixed step");
              if (options.h_min > 0) config.at("h_min").fail("has no meaning with a fixed step");
            });
    return s;
  }
  static MethodFacts facts() {
    return method_facts("2-5, by `table`", "L-stable, stiffly accurate", "linear invariants (momentum)",
                        "Reynolds et al., ACM TOMS 49, 2023; Kennedy & Carpenter, NASA TM-2016-219173");
  }
  std::unique_ptr<Integrator> make(const Model& model, const Task& task) const override {
    return std::make_unique<ArkodeDirk>(model, Settings::complete(*this, task), *this);
  }
};

const bool registered = Registry<IntegratorChoice>::add<ArkodeDirkChoice>(
    "arkode_dirk", "ARKODE: diagonally implicit Runge-Kutta methods of order 2-5, adaptive or with a fixed step.");

}  // namespace
}  // namespace orthodyn::sundials
