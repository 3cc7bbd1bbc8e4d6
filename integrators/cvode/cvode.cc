#include "integrators/cvode/cvode.h"

#include <cvodes/cvodes.h>
#include <cvodes/cvodes_ls.h>
#include <fmt/format.h>
#include <sunnonlinsol/sunnonlinsol_fixedpoint.h>

#include <algorithm>

#include "integrators/cvode/backward_problem.h"
#include "integrators/run_checks.h"
#include "integrators/sundials/constraint_forces.h"
#include "integrators/sundials/constraint_projection.h"
#include "integrators/sundials/forward_sensitivities.h"
#include "integrators/sundials/multiplier_history.h"
#include "integrators/sundials/secant_newton.h"
#include "integrators/sundials/sundials_integrator.h"
#include "lib/ode/constraints_at.h"

namespace orthodyn::sundials {

namespace {

constexpr LibraryCalls kCvodeCalls = [] {
  LibraryCalls calls = ORTHODYN_LIBRARY_CALLS(CVode);
  calls.set_factor_interval = CVodeSetLSetupFrequency;
  calls.set_tangent_interval = CVodeSetJacEvalFrequency;
  return calls;
}();

// All numbers of both lists, ascending.
std::vector<double> united(std::vector<double> a, const std::vector<double>& b) {
  a.insert(a.end(), b.begin(), b.end());
  std::ranges::sort(a);
  a.erase(std::unique(a.begin(), a.end()), a.end());
  return a;
}

struct FreeCvode {
  void operator()(void* memory) const { CVodeFree(&memory); }
};

class Cvode final : public SundialsIntegrator {
 public:
  Cvode(const CvodeMethod& method, const Model& model, const Options& options, const Scales& scales,
        SensitivityEquations* sensitivities)
      : SundialsIntegrator(method.name, kCvodeCalls, model, options, scales, !method.anderson),
        method_(method),
        constraint_forces_(model),
        memory_(CVodeCreate(method.family, context_)) {
    check_mass_for_full_jacobian();
    if (!memory_) throw RunError("CVODE could not be created");
    if (method.family == CV_BDF) decisions_.emplace_back("max_order", std::to_string(method.max_order));
    if (sensitivities) sensitivities_.emplace(*sensitivities, model, y(), callback_context_, statistics_);
  }

  void interpolate(double t, State& out) const override {
    SundialsIntegrator::interpolate(t, out);
    if (model_.constraints()) out.lambda = multipliers_.at(t, std::max(1, last_order()));
  }

  void interpolate_sensitivity(int i, double t, State& out) const override {
    const OwnedVector dense(N_VClone(y()));
    if (CVodeGetSensDky1(memory(), t, 0, i, dense.get()) < 0)
      throw RunError(fmt::format("CVODES cannot interpolate the sensitivities at t = {:.17g} s: {}", t,
                                 callback_context_.message));
    out = ForwardSensitivities::state(t, dense.get());
  }

  // Integrates from the task's start to the last time of the equations, and the adjoint equations back.
  AdjointSolution integrate_adjoint(const Task& task, AdjointEquations& equations) {
    if (options_.is_full())
      throw ConfigError("integrator.linear_solver", "klu_full is not available for adjoint equations: use klu or auto");
    start(task.initial);
    const std::vector<double>& times = equations.times();
    const double begin = task.initial.t, end = times.back();
    const StepLimits limits = model_.step_limits(begin, end);
    std::vector<double> kinks = model_.breakpoints(begin, end);
    std::erase_if(kinks, [&](double t) { return t <= begin || t >= end; });
    std::vector<double> stops = united(times, kinks);
    require(CVodeAdjInit(memory(), steps_between_checkpoints(), CV_POLYNOMIAL));
    std::vector<State> states;
    long forward_steps = 0;
    for (double t = begin; const double stop : stops) {
      while (t < stop) {
        forward_step(std::min(stop, limits.latest_end(t)), ++forward_steps, t);
        equations.on_forward_step(t);
      }
      states.push_back({t, positions(y()), velocities(y())});
    }
    BackwardProblem backward(memory(), model_, options_, method_.max_order, scales_, equations, y(), callback_context_,
                             statistics_, context_);
    std::vector<double> ends = united(limits.ends(), {});
    std::size_t left = times.size();
    for (std::size_t k = stops.size(); k-- > 0;) {
      if (left > 0 && times[left - 1] == stops[k]) backward.jump(--left, states[k]);
      else backward.restart(stops[k]);
      const double before = k > 0 ? stops[k - 1] : begin;
      for (; !ends.empty() && ends.back() > before; ends.pop_back())
        if (ends.back() < stops[k]) backward.integrate_to(ends.back());
      backward.integrate_to(before);
    }
    AdjointSolution out = backward.solution();
    out.forward_steps = forward_steps;
    return out;
  }

 private:
  // The states of so many steps are kept, for interpolation while the adjoint equations are integrated. Beyond the last
  // checkpoint, the motion is integrated again.
  long steps_between_checkpoints() const {
    constexpr double kMemory = 5e8;  // bytes
    constexpr long kFewest = 20, kMost = 10000;
    return std::clamp(static_cast<long>(kMemory / (static_cast<double>(size()) * sizeof(double))), kFewest, kMost);
  }

  // Takes a step, which ends at `stop` at the latest, and keeps its data for the adjoint equations. `count`: of the
  // steps.
  void forward_step(double stop, long count, double& t) {
    if (count > options_.max_steps) throw too_many_steps_error(method_.name, t, count - 1, "integrator.rtol");
    callback_context_ = {};
    require(CVodeSetStopTime(memory(), stop));
    int checkpoints = 0;
    finish(CVodeF(memory(), stop, y(), &t, CV_ONE_STEP, &checkpoints));
  }

  void* memory() const override { return memory_.get(); }

  void initialise(double t) override {
    void* m = memory();
    fit_velocities(t);
    ORTHODYN_CAPTURE_ERRORS(CVodeSetErrHandlerFn, context_, m, &callback_context_.message);
    require(CVodeInit(m, right_hand_side, t, y()));
    set_error_weights();
    require(CVodeSetMaxOrd(m, method_.max_order));
    set_step_limits();
    method_.anderson ? use_fixed_point() : use_newton();
    if (model_.constraints()) {
      require(CVodeSetProjFn(m, project));
      // The error of a motion that constraints prescribe is its violation of them: it must not be removed.
      require(CVodeSetProjErrEst(m, SUNFALSE));
    }
    require(CVodeSetNonlinConvCoef(m, options_.nonlinear_coefficient));
    require(CVodeSetMaxNonlinIters(m, options_.max_newton_iterations));
    if (sensitivities_) start_sensitivities();
  }

  void start_sensitivities() {
    void* m = memory();
    sensitivities_->start();
    require(CVodeSensInit1(m, sensitivities_->count(), corrector(), sensitivity_derivative, sensitivities_->values()));
    require(CVodeSetSensParams(m, nullptr, sensitivities_->scales().data(), nullptr));
    require(CVodeSensSVtolerances(m, options_.rtol, sensitivities_->tolerances(options_.rtol, scales_)));
    require(CVodeSetSensErrCon(m, 1));
    // The iteration of the simultaneous corrector exists only now.
    if (method_.simultaneous) require(CVodeSetMaxNonlinIters(m, options_.max_newton_iterations));
  }

  int corrector() const { return method_.simultaneous ? CV_SIMULTANEOUS : CV_STAGGERED; }

  // Sensitivities are continuous at t, the end of the last step.
  void reinitialise(double t) override {
    if (sensitivities_) require(CVodeGetSensDky(memory(), t, 0, sensitivities_->values()));
    fit_velocities(t);
    require(CVodeReInit(memory(), t, y()));
    if (sensitivities_) require(CVodeSensReInit(memory(), corrector(), sensitivities_->values()));
  }

  // Removes velocities that violate the constraints, and starts the history of multipliers.
  void fit_velocities(double t) {
    if (!model_.constraints()) return;
    ConstraintsAt(model_, t, positions(y(), extra())).fit(velocities(y(), extra()));
    multipliers_.clear();
    projected_q_.setZero(model_.num_dofs());
    projected_v_.setZero(model_.num_dofs());
    add_multipliers(t);
  }

  // Computes the multipliers at the end of a step, at the solution of its equations. The projection deforms bodies at
  // their joints: elastic forces, and multipliers, would be less accurate behind it, and between the ends of steps.
  void add_multipliers(double t) {
    Vector a(model_.num_dofs());
    const Vector q = positions(y(), extra()) - projected_q_, v = velocities(y(), extra()) - projected_v_;
    try {
      if (internal_)
        internal_->internal().force(t, q, v, {InternalState::Kind::given, internal_part(y(), extra()).data(), 0}, a);
      else model_.force(t, q, v, a);
    } catch (const RecoverableError&) {
      return multipliers_.clear();
    }
    model_.solve_mass(a);
    multipliers_.add(t, constraint_forces_.multipliers(t, q, v, a));
  }

  int advance(double t_stop, double& t) override {
    require(CVodeSetStopTime(memory(), t_stop));
    const int flag = step_with_matrix_renewal([&] { return CVode(memory(), t_stop, y(), &t, CV_ONE_STEP); });
    if (flag >= 0 && model_.constraints()) add_multipliers(t);
    return flag;
  }

  int last_order() const override {
    int order = 0;
    CVodeGetLastOrder(memory(), &order);
    return order;
  }

  int dense_output(double t, N_Vector out) const override { return CVodeGetDky(memory(), t, 0, out); }

  Reason classify(int flag) const override {
    switch (flag) {
      case CV_ERR_FAILURE: return Reason::error_test;
      case CV_CONV_FAILURE:
      case CV_LSETUP_FAIL:
      case CV_NLS_FAIL: return Reason::newton;
      case CV_SRHSFUNC_FAIL:
      case CV_FIRST_SRHSFUNC_ERR:
      case CV_REPTD_SRHSFUNC_ERR:
      case CV_UNREC_SRHSFUNC_ERR:
      case CV_RHSFUNC_FAIL:
      case CV_FIRST_RHSFUNC_ERR:
      case CV_REPTD_RHSFUNC_ERR:
      case CV_UNREC_RHSFUNC_ERR: return Reason::force;
      case CV_PROJFUNC_FAIL:
      case CV_REPTD_PROJFUNC_ERR: return Reason::newton;
      case CV_TOO_MUCH_ACC: return Reason::diverged;
      case CV_TOO_CLOSE: return Reason::step_too_small;
      default: return Reason::other;
    }
  }

  std::size_t own_bytes() const override {
    return (secant_newton_ ? secant_newton_->bytes() : 0) + (sensitivities_ ? sensitivities_->bytes() : 0);
  }

  std::string iteration_failure() const override {
    if (!method_.anderson) return SundialsIntegrator::iteration_failure();
    return explained("the fixed-point iteration does not converge at the smallest step",
                     "; set integrator.nonlinear: newton, or lower h_min");
  }

  void use_fixed_point() {
    fixed_point_.reset(SUNNonlinSol_FixedPoint(y(), *method_.anderson, context_));
    if (!fixed_point_) throw RunError("SUNDIALS could not create its fixed-point iteration", Reason::out_of_memory);
    require(CVodeSetNonlinearSolver(memory(), fixed_point_.get()));
  }

  void use_newton() {
    if (model_.traits().smooth) {
      secant_newton_.emplace(y(), context_, callback_context_, model_.space(), newton_system_->least_rate());
      require(CVodeSetNonlinearSolver(memory(), secant_newton_->get()));
    } else {
      use_nonsmooth_newton();
    }
    newton_system_->create_first_order(context_, [this] {
      sunrealtype gamma = 0;
      CVodeGetCurrentGamma(memory(), &gamma);
      return gamma;
    });
    attach_linear_solver();
    require(newton_system_->is_full() ? CVodeSetJacFn(memory(), fill_jacobian) : CVodeSetLinSysFn(memory(), linearize));
    // Gamma may drift by 50 % before the matrix is refactored, which saves 10-20 % of the refactorisations.
    require(CVodeSetDeltaGammaMaxLSetup(memory(), 0.5));
  }

  // Callbacks.
  static Cvode& self(void* user) { return static_cast<Cvode&>(*static_cast<SundialsIntegrator*>(user)); }

  static int right_hand_side(sunrealtype t, N_Vector y, N_Vector y_dot, void* user) {
    auto& me = self(user);
    const Extra m = me.extra();
    positions(y_dot, m) = velocities(y, m);
    int flag = me.evaluate_acceleration(me.model_, t, y, velocities(y_dot, m));
    if (!flag && me.model_.constraints())
      flag = guarded(me.callback_context_, [&] {
        me.constraint_forces_.multipliers(t, positions(y, m), velocities(y, m), velocities(y_dot, m));
      });
    return flag ? flag : me.evaluate_internal_rates(t, y, y_dot);
  }

  // Computes the change of y that puts it on the constraints.
  static int project(sunrealtype t, N_Vector y, N_Vector change, sunrealtype tolerance, N_Vector, void* user) {
    auto& me = self(user);
    const Extra m = me.extra();
    return guarded(me.callback_context_, [&] {
      N_VConst(0, change);
      const Projection project{*me.model_.constraints(), me.newton_system_->constraint_directions(),
                               ScaledNorm(me.options_.rtol, me.scales_), tolerance};
      project(t, positions(y, m), velocities(y, m), positions(change, m), velocities(change, m));
      me.projected_q_ = positions(change, m);
      me.projected_v_ = velocities(change, m);
    });
  }

  static int sensitivity_derivative(int, sunrealtype t, N_Vector y, N_Vector y_dot, int i, N_Vector s, N_Vector s_dot,
                                    void* user, N_Vector, N_Vector) {
    return self(user).sensitivities_->first_order(i, t, y, y_dot, s, s_dot);
  }

  static int linearize(sunrealtype t, N_Vector y, N_Vector, SUNMatrix, sunbooleantype keep, sunbooleantype* renewed,
                       sunrealtype, void* user, N_Vector, N_Vector, N_Vector) {
    return self(user).newton_system_->linearize(t, y, keep, renewed);
  }

  static int fill_jacobian(sunrealtype t, N_Vector y, N_Vector, SUNMatrix J, void* user, N_Vector, N_Vector, N_Vector) {
    return self(user).newton_system_->fill_jacobian(t, y, J);
  }

  CvodeMethod method_;
  ConstraintForces constraint_forces_;
  Vector projected_q_, projected_v_;  // the changes by the last projection
  MultiplierHistory multipliers_;
  std::optional<ForwardSensitivities> sensitivities_;
  std::optional<SecantNewton> secant_newton_;
  Owned<SUNNonlinearSolver, SUNNonlinSolFree> fixed_point_;
  std::unique_ptr<void, FreeCvode> memory_;
};

}  // namespace

std::unique_ptr<Integrator> make_cvode(const CvodeMethod& method, const Model& model, const Options& options,
                                       const Scales& scales, SensitivityEquations* sensitivities) {
  return std::make_unique<Cvode>(method, model, options, scales, sensitivities);
}

AdjointSolution integrate_cvode_adjoint(const CvodeMethod& method, const Model& model, const Options& options,
                                        const Scales& scales, const Task& task, AdjointEquations& equations) {
  return Cvode(method, model, options, scales, nullptr).integrate_adjoint(task, equations);
}

}  // namespace orthodyn::sundials
