#include "integrators/cvode/cvode.h"

#include <cvode/cvode.h>
#include <cvode/cvode_ls.h>

namespace orthodyn::sundials {

namespace {

Cvode& cvode(void* user) { return *static_cast<Cvode*>(user); }

}  // namespace

void Cvode::FreeMemory::operator()(void* memory) const { CVodeFree(&memory); }

Cvode::Cvode(const std::string& name, const Model& model, const Settings& settings, int family, int max_order)
    : FirstOrderIntegrator(name, model, settings), max_order_(max_order), memory_(CVodeCreate(family, context_)) {
  if (!memory_) throw RunError("CVODE could not be created");
}

void Cvode::initialise(double t) {
  void* m = memory();
  ORTHODYN_CAPTURE_ERRORS(CVodeSetErrHandlerFn, context_, m, &callback_context_.message);
  require(CVodeInit(
      m, [](sunrealtype time, N_Vector y, N_Vector y_dot, void* user) { return cvode(user).evaluate(time, y, y_dot); },
      t, y()));
  require(CVodeSetUserData(m, this));
  require(CVodeWFtolerances(m, [](N_Vector, N_Vector weights, void* user) {
    cvode(user).settings_.set_weights(weights);
    return 0;
  }));
  const auto& o = settings_.options;
  require(CVodeSetMaxOrd(m, max_order_));
  if (o.h0) require(CVodeSetInitStep(m, *o.h0));
  if (o.h_max) require(CVodeSetMaxStep(m, *o.h_max));
  if (o.h_min > 0) require(CVodeSetMinStep(m, o.h_min));
  choose_iteration();
  require(CVodeSetNonlinConvCoef(m, o.nonlinear_coefficient));
  require(CVodeSetMaxNonlinIters(m, o.max_newton_iterations));
}

void Cvode::reinitialise(double t) { require(CVodeReInit(memory(), t, y())); }

int Cvode::advance(double t_stop, double& t) {
  require(CVodeSetStopTime(memory(), t_stop));
  if (!reduced_ && !settings_.full) return CVode(memory(), t_stop, y(), &t, CV_ONE_STEP);  // without a matrix
  require(CVodeSetLSetupFrequency(memory(), setups_.interval()));
  require(CVodeSetJacEvalFrequency(memory(), setups_.interval() == 1 ? 1 : 0));  // 0: the library's own
  const long tangents = statistics_.tangent.count;
  const int flag = CVode(memory(), t_stop, y(), &t, CV_ONE_STEP);
  setups_.note(statistics_.tangent.count > tangents);
  return flag;
}

StepInfo Cvode::last_step() const {
  StepInfo info;
  CVodeGetLastStep(memory(), &info.h);
  CVodeGetLastOrder(memory(), &info.order);
  return info;
}

double Cvode::current_step() const {
  sunrealtype h = 0;
  CVodeGetCurrentStep(memory(), &h);
  return h;
}

int Cvode::dense_output(double t, N_Vector out) const { return CVodeGetDky(memory(), t, 0, out); }

Cvode::Counters Cvode::counters() const {
  Counters c;
  CVodeGetNumSteps(memory(), &c.steps);
  CVodeGetNumErrTestFails(memory(), &c.error_test_failures);
  CVodeGetNumStepSolveFails(memory(), &c.convergence_failures);
  CVodeGetNumNonlinSolvIters(memory(), &c.newton_iterations);
  return c;
}

Reason Cvode::classify(int flag) const {
  switch (flag) {
    case CV_ERR_FAILURE: return Reason::error_test;
    case CV_CONV_FAILURE:
    case CV_LSETUP_FAIL:
    case CV_NLS_FAIL: return Reason::newton;
    case CV_RHSFUNC_FAIL:
    case CV_FIRST_RHSFUNC_ERR:
    case CV_REPTD_RHSFUNC_ERR:
    case CV_UNREC_RHSFUNC_ERR: return Reason::force;
    case CV_TOO_MUCH_ACC: return Reason::diverged;
    case CV_TOO_CLOSE: return Reason::step_too_small;
    default: return Reason::other;
  }
}

std::size_t Cvode::workspace_bytes() const {
  long reals = 0, integers = 0;
  CVodeGetWorkSpace(memory(), &reals, &integers);
  return static_cast<std::size_t>(reals) * sizeof(sunrealtype) + (newton_ ? newton_->bytes() : 0);
}

void Cvode::attach_newton() {
  if (model_.traits().smooth) {
    newton_.emplace(y(), context_, callback_context_, model_.space(), reduced_ ? reduced_->least_rate() : 0);
    require(CVodeSetNonlinearSolver(memory(), newton_->get()));
  } else {
    newton_at_kinks_.emplace(settings_.options.rtol, y(), context_);
    require(CVodeSetNonlinearSolver(memory(), newton_at_kinks_->get()));
    newton_at_kinks_->replace_test();
  }
  settings_.full ? attach_full() : attach_reduced();
  // A drifting gamma costs a refactorisation only from 50 % on: 10-20 % fewer of them.
  require(CVodeSetDeltaGammaMaxLSetup(memory(), 0.5));
}

void Cvode::attach_reduced() {
  make_first_order_solver([this] {
    sunrealtype gamma = 0;
    CVodeGetCurrentGamma(memory(), &gamma);
    return gamma;
  });
  require(CVodeSetLinearSolver(memory(), solver_.get(), matrix_.get()));
  require(CVodeSetLinSysFn(memory(), [](sunrealtype t, N_Vector y, N_Vector, SUNMatrix, sunbooleantype jok,
                                        sunbooleantype* jcur, sunrealtype, void* user, N_Vector, N_Vector,
                                        N_Vector) { return cvode(user).linearize_reduced(t, y, jok, jcur); }));
}

void Cvode::attach_full() {
  make_full_solver();
  require(CVodeSetLinearSolver(memory(), solver_.get(), matrix_.get()));
  require(CVodeSetJacFn(memory(), [](sunrealtype t, N_Vector y, N_Vector, SUNMatrix J, void* user, N_Vector, N_Vector,
                                     N_Vector) { return cvode(user).fill_full(t, y, J); }));
}

}  // namespace orthodyn::sundials
