#include "integrators/arkode/ark_step.h"

#include "integrators/fixed_step.h"

namespace orthodyn::sundials {

namespace {

constexpr int kMaxRetries = 20;
constexpr double kRetryFactor = 0.25;

ArkStep& ark_step(void* user) { return *static_cast<ArkStep*>(user); }

}  // namespace

void ArkStep::initialise(double t) {
  begin_at(t);
  memory_.reset(ARKStepCreate(parts_.explicit_part, parts_.implicit_part, t, y(), context_));
  void* m = memory();
  if (!m) throw RunError("ARKODE could not be created");
  ORTHODYN_CAPTURE_ERRORS(ARKStepSetErrHandlerFn, context_, m, &callback_context_.message);
  require(ARKStepSetUserData(m, this));
  require(ARKStepWFtolerances(m, [](N_Vector, N_Vector weights, void* user) {
    ark_step(user).settings_.set_weights(weights);
    return 0;
  }));
  const auto& o = settings_.options;
  if (o.h0) require(ARKStepSetInitStep(m, *o.h0));
  if (o.h_max) require(ARKStepSetMaxStep(m, *o.h_max));
  if (o.h_min > 0) require(ARKStepSetMinStep(m, o.h_min));
  // Degree 3 is the highest that evaluates no force; it serves predictors alone.
  require(ARKStepSetInterpolantDegree(m, 3));
  choose_method();
}

void ArkStep::reinitialise(double t) {
  begin_at(t);
  retries_ = 0;
  require(ARKStepReInit(memory(), parts_.explicit_part, parts_.implicit_part, t, y()));
}

void ArkStep::begin_at(double t) {
  end_ = {t, positions(y()), velocities(y()), Vector(model_.num_dofs())};
  begin_acceleration(t, end_.a);
}

int ArkStep::advance(double t_stop, double& t) {
  if (step_) require(ARKStepSetFixedStep(memory(), length_of_fixed_step(*step_, t_stop - t)));
  for (int attempt = 0;; ++attempt) {
    require(ARKStepSetStopTime(memory(), t_stop));
    sunrealtype reached = t;  // after a failure the time of a stage
    const int flag = ARKStepEvolve(memory(), t_stop, y(), &reached, ARK_ONE_STEP);
    if (flag >= 0) take_end(t = reached);
    if (flag != ARK_UNREC_RHSFUNC_ERR || attempt == kMaxRetries || !retry_with_shorter_step()) return flag;
  }
}

// ARKODE gives up where the force fails in an explicit stage: the step is begun anew from its known
// beginning. False if no shorter one is allowed.
bool ArkStep::retry_with_shorter_step() {
  const double h = kRetryFactor * current_step();
  if (step_ || callback_context_.failure || h < settings_.options.h_min || end_.t + h == end_.t) return false;
  ++retries_;
  positions(y()) = end_.q;
  velocities(y()) = end_.v;
  require(ARKStepReset(memory(), end_.t, y()));
  require(ARKStepSetInitStep(memory(), h));
  return true;
}

void ArkStep::take_end(double t) {
  std::swap(begin_, end_);
  end_.t = t;
  end_.q = positions(y());
  end_.v = velocities(y());
  end_.a.resize(model_.num_dofs());
  end_acceleration(end_.a);
}

Eigen::Map<Vector> ArkStep::stage_acceleration() const {
  sunrealtype at, gamma;
  N_Vector predicted, stage, stage_derivative, data;
  void* user;
  require(ARKStepGetNonlinearSystemData(memory(), &at, &predicted, &stage, &stage_derivative, &gamma, &data, &user));
  return velocities(stage_derivative);
}

StepInfo ArkStep::last_step() const {
  StepInfo info;
  ARKStepGetLastStep(memory(), &info.h);
  info.order = order_;
  return info;
}

double ArkStep::current_step() const {
  sunrealtype h = 0;
  ARKStepGetCurrentStep(memory(), &h);
  return h;
}

int ArkStep::dense_output(double t, N_Vector out) const {
  orthodyn::interpolate(begin_, end_, t, positions(out), velocities(out));
  return 0;
}

ArkStep::Counters ArkStep::counters() const {
  Counters c;
  ARKStepGetNumSteps(memory(), &c.steps);
  ARKStepGetNumErrTestFails(memory(), &c.error_test_failures);
  ARKStepGetNumStepSolveFails(memory(), &c.convergence_failures);
  c.convergence_failures += retries_;
  if (settings_.implicit) ARKStepGetNumNonlinSolvIters(memory(), &c.newton_iterations);
  return c;
}

Reason ArkStep::classify(int flag) const {
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
    case ARK_TOO_MUCH_ACC: return Reason::diverged;
    case ARK_TOO_CLOSE: return Reason::step_too_small;
    default: return Reason::other;
  }
}

std::size_t ArkStep::workspace_bytes() const {
  long reals = 0, integers = 0;
  ARKStepGetWorkSpace(memory(), &reals, &integers);
  return (static_cast<std::size_t>(reals) + 3 * static_cast<std::size_t>(size())) * sizeof(sunrealtype);
}

// Figures: docs/decisions.md.
void ArkStep::attach_newton() {
  void* m = memory();
  const auto& o = settings_.options;
  require(ARKStepSetNonlinConvCoef(m, o.nonlinear_coefficient));
  require(ARKStepSetMaxNonlinIters(m, o.max_newton_iterations));
  if (!model_.traits().smooth) {
    newton_.emplace(o.rtol, y(), context_);
    require(ARKStepSetNonlinearSolver(m, newton_->get()));
    newton_->replace_test();
  }
  settings_.full ? attach_full() : attach_reduced();
  // The derivative of a stage is taken from its solution: a force evaluated there would multiply what
  // Newton left by the stiffness, and could fail after Newton has converged.
  require(ARKStepSetDeduceImplicitRhs(m, SUNTRUE));
  // Early stages are extrapolated by a high order, late ones by a low one: half the iterations of the
  // library's own choice, the last solution.
  require(ARKStepSetPredictorMethod(m, 2));
  // The rate of convergence is not remembered. On a linear model it is all but zero, and Newton
  // would take one iteration for enough even after gamma has moved.
  require(ARKStepSetNonlinCRDown(m, 1));
}

void ArkStep::attach_reduced() {
  make_first_order_solver([this] {
    sunrealtype gamma = 0;
    ARKStepGetCurrentGamma(memory(), &gamma);
    return gamma;
  });
  require(ARKStepSetLinearSolver(memory(), solver_.get(), matrix_.get()));
  require(ARKStepSetLinSysFn(memory(), [](sunrealtype t, N_Vector y, N_Vector, SUNMatrix, SUNMatrix, sunbooleantype jok,
                                          sunbooleantype* jcur, sunrealtype, void* user, N_Vector, N_Vector,
                                          N_Vector) { return ark_step(user).linearize_reduced(t, y, jok, jcur); }));
}

void ArkStep::attach_full() {
  make_full_solver();
  require(ARKStepSetLinearSolver(memory(), solver_.get(), matrix_.get()));
  require(ARKStepSetJacFn(memory(), [](sunrealtype t, N_Vector y, N_Vector, SUNMatrix J, void* user, N_Vector, N_Vector,
                                       N_Vector) { return ark_step(user).fill_full(t, y, J); }));
}

}  // namespace orthodyn::sundials
