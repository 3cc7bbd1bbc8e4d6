// CVODE's BDF (Hindmarsh et al. 2005): variable order 1-5, variable step, modified Newton.
#include <cvode/cvode.h>
#include <cvode/cvode_ls.h>

#include "integrators/sundials/first_order.h"
#include "integrators/sundials/multistep.h"

namespace orthodyn::sundials {
namespace {

struct FreeMemory {
  void operator()(void* memory) const { CVodeFree(&memory); }
};

class CvodeBdf : public FirstOrderIntegrator {
 public:
  CvodeBdf(const Model& model, const MultistepSettings& settings)
      : FirstOrderIntegrator("cvode_bdf", model, settings), max_order_(settings.max_order),
        memory_(CVodeCreate(CV_BDF, context_)) {
    if (!memory_) throw RunError("CVODE could not be created");
  }

 protected:
  void initialise(double t) override {
    void* m = memory_.get();
    ORTHODYN_CAPTURE_ERRORS(CVodeSetErrHandlerFn, context_, m, &border_.library_message);
    require(CVodeInit(m, right_hand_side, t, y()));
    require(CVodeSetUserData(m, this));
    require(CVodeWFtolerances(m, [](N_Vector, N_Vector weights, void* user) {
      self(user).settings_.set_weights(weights);
      return 0;
    }));
    const auto& o = settings_.options;
    require(CVodeSetMaxOrd(m, max_order_));
    require(CVodeSetNonlinConvCoef(m, o.nonlinear_coefficient));
    require(CVodeSetMaxNonlinIters(m, o.max_newton_iterations));
    if (o.h0) require(CVodeSetInitStep(m, *o.h0));
    if (o.h_max) require(CVodeSetMaxStep(m, *o.h_max));
    if (o.h_min > 0) require(CVodeSetMinStep(m, o.h_min));
    settings_.full ? attach_full() : attach_reduced();
    // A drifting gamma costs a refactorisation only from 50 % on: 10-20 % fewer of them.
    require(CVodeSetDeltaGammaMaxLSetup(m, 0.5));
  }

  void reinitialise(double t) override { require(CVodeReInit(memory_.get(), t, y())); }

  int advance(double t_stop, double& t) override {
    require(CVodeSetStopTime(memory_.get(), t_stop));
    return CVode(memory_.get(), t_stop, y(), &t, CV_ONE_STEP);
  }

  StepInfo last_step() const override {
    StepInfo info;
    CVodeGetLastStep(memory_.get(), &info.h);
    CVodeGetLastOrder(memory_.get(), &info.order);
    return info;
  }

  double current_step() const override {
    sunrealtype h = 0;
    CVodeGetCurrentStep(memory_.get(), &h);
    return h;
  }

  int dense_output(double t, N_Vector out) const override { return CVodeGetDky(memory_.get(), t, 0, out); }

  Counters counters() const override {
    Counters c;
    void* m = memory_.get();
    CVodeGetNumSteps(m, &c.steps);
    CVodeGetNumErrTestFails(m, &c.error_test_failures);
    CVodeGetNumStepSolveFails(m, &c.convergence_failures);
    CVodeGetNumNonlinSolvIters(m, &c.newton_iterations);
    return c;
  }

  Reason classify(int flag) const override {
    switch (flag) {
      case CV_ERR_FAILURE: return Reason::error_test;
      case CV_CONV_FAILURE:
      case CV_LSETUP_FAIL:
      case CV_NLS_FAIL: return Reason::newton;
      case CV_RHSFUNC_FAIL:
      case CV_FIRST_RHSFUNC_ERR:
      case CV_REPTD_RHSFUNC_ERR:
      case CV_UNREC_RHSFUNC_ERR: return Reason::force;
      case CV_TOO_CLOSE: return Reason::step_too_small;
      default: return Reason::other;
    }
  }

  std::size_t workspace_bytes() const override {
    long reals = 0, integers = 0;
    CVodeGetWorkSpace(memory_.get(), &reals, &integers);
    return static_cast<std::size_t>(reals) * sizeof(sunrealtype);
  }

 private:
  static CvodeBdf& self(void* user) { return *static_cast<CvodeBdf*>(user); }

  static int right_hand_side(sunrealtype t, N_Vector y, N_Vector y_dot, void* user) {
    return self(user).evaluate(t, y, y_dot);
  }

  void attach_reduced() {
    make_first_order_solver([this] {
      sunrealtype gamma = 0;
      CVodeGetCurrentGamma(memory_.get(), &gamma);
      return gamma;
    });
    require(CVodeSetLinearSolver(memory_.get(), solver_.get(), matrix_.get()));
    require(CVodeSetLinSysFn(memory_.get(), [](sunrealtype t, N_Vector y, N_Vector, SUNMatrix, sunbooleantype jok,
                                               sunbooleantype* jcur, sunrealtype, void* user, N_Vector, N_Vector,
                                               N_Vector) { return self(user).linearize_reduced(t, y, jok, jcur); }));
  }

  void attach_full() {
    make_full_solver();
    require(CVodeSetLinearSolver(memory_.get(), solver_.get(), matrix_.get()));
    require(CVodeSetJacFn(memory_.get(), [](sunrealtype t, N_Vector y, N_Vector, SUNMatrix J, void* user, N_Vector,
                                            N_Vector, N_Vector) { return self(user).fill_full(t, y, J); }));
  }

  int max_order_;
  std::unique_ptr<void, FreeMemory> memory_;
};

class CvodeBdfChoice : public IntegratorChoice, public MultistepOptions {
 public:
  static const Spec<CvodeBdfChoice>& spec() {
    static const auto s = MultistepOptions::spec_for<CvodeBdfChoice>();
    return s;
  }
  static MethodFacts facts() {
    return method_facts("1-5, variable", "A-stable and damping at order 1-2, A(alpha) at 3-5 (alpha 86 to 51 degrees)",
                        "linear invariants (momentum); energy of oscillations is damped",
                        "Hindmarsh et al., ACM TOMS 31, 2005; Curtiss & Hirschfelder 1952");
  }
  std::unique_ptr<Integrator> make(const Model& model, const Task& task) const override {
    return std::make_unique<CvodeBdf>(model, MultistepSettings::complete(*this, model, task));
  }
};

const bool registered = Registry<IntegratorChoice>::add<CvodeBdfChoice>(
    "cvode_bdf", "CVODE: backward differentiation formulas of order 1-5, adaptive, implicit.");

}  // namespace
}  // namespace orthodyn::sundials
