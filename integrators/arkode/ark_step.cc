#include "integrators/arkode/ark_step.h"

#include <arkode/arkode_arkstep.h>

#include "integrators/fixed_step.h"
#include "integrators/sundials/stage_newton.h"
#include "integrators/sundials/sundials_integrator.h"
#include "lib/ode/hermite.h"

namespace orthodyn::sundials {

namespace {

constexpr int kMaxRetries = 20;
constexpr double kRetryFactor = 0.25;

constexpr LibraryCalls kArkCalls = [] {
  LibraryCalls calls = ORTHODYN_LIBRARY_CALLS(ARKStep);
  calls.set_factor_interval = [](void* memory, long steps) {
    return ARKStepSetLSetupFrequency(memory, static_cast<int>(steps));
  };
  calls.set_tangent_interval = ARKStepSetJacEvalFrequency;
  return calls;
}();

struct FreeArkStep {
  void operator()(void* memory) const { ARKStepFree(&memory); }
};

// The part of the force that one table integrates, as accelerations M^-1 f in m/s^2.
struct ArkPart {
  const Model* model = nullptr;  // null: the method has no such part
  Vector last;                   // acceleration at the last evaluated stage
  Vector at_end;                 // acceleration at the end of the last step
};

// A base class, so that the models of a split force outlive the integrator that refers to them.
struct OwnedMethod {
  ArkMethod method_;
};

class ArkStep final : private OwnedMethod, public SundialsIntegrator {
 public:
  // If the force is split, K and D are those of the implicit part.
  ArkStep(const Model& model, ArkMethod method, const Options& options, const Scales& scales)
      : OwnedMethod{std::move(method)},
        SundialsIntegrator(method_.name, kArkCalls, method_.split.implicit_part ? *method_.split.implicit_part : model,
                           options, scales, method_.implicit_table != nullptr) {
    check_mass_for_full_jacobian();
    if (method_.explicit_table) add_part(explicit_, method_.split.explicit_part ? *method_.split.explicit_part : model);
    if (method_.implicit_table) add_part(implicit_, model_);
  }

  bool adaptive() const override { return !method_.step; }

 private:
  void* memory() const override { return memory_.get(); }

  static void add_part(ArkPart& part, const Model& model) {
    part = {&model, Vector(model.num_dofs()), Vector(model.num_dofs())};
  }
  bool is_split() const { return explicit_.model && implicit_.model; }
  ArkPart& only_part() { return implicit_.model ? implicit_ : explicit_; }
  const ARKodeButcherTableMem& main_table() const {
    return method_.implicit_table ? *method_.implicit_table : *method_.explicit_table;
  }

  void initialise(double t) override {
    begin_at(t);
    memory_.reset(ARKStepCreate(explicit_callback(), implicit_callback(), t, y(), context_));
    void* m = memory();
    if (!m) throw RunError("ARKODE could not be created");
    ORTHODYN_CAPTURE_ERRORS(ARKStepSetErrHandlerFn, context_, m, &callback_context_.message);
    set_error_weights();
    set_step_limits();
    // Degree 3 is the highest that needs no force evaluation. Only predictors use this interpolant.
    require(ARKStepSetInterpolantDegree(m, 3));
    require(ARKStepSetTables(m, main_table().q, main_table().p, method_.implicit_table.get(),
                             method_.explicit_table.get()));
    if (newton_system_) use_newton();
  }

  void reinitialise(double t) override {
    begin_at(t);
    retries_ = 0;
    require(ARKStepReInit(memory(), explicit_callback(), implicit_callback(), t, y()));
  }

  int advance(double t_stop, double& t) override {
    if (method_.step) require(ARKStepSetFixedStep(memory(), length_of_fixed_step(*method_.step, t_stop - t)));
    for (int attempt = 0;; ++attempt) {
      require(ARKStepSetStopTime(memory(), t_stop));
      sunrealtype reached = t;  // after a failure, the time of a stage
      const int flag =
          step_with_matrix_renewal([&] { return ARKStepEvolve(memory(), t_stop, y(), &reached, ARK_ONE_STEP); });
      if (flag >= 0) take_end(t = reached);
      if (flag != ARK_UNREC_RHSFUNC_ERR || attempt == kMaxRetries || !retry_with_shorter_step()) return flag;
    }
  }

  // ARKODE gives up if the force fails in an explicit stage. This function restarts the step with a quarter of its
  // length. False if no shorter step is allowed.
  bool retry_with_shorter_step() {
    const double h = kRetryFactor * current_step();
    if (method_.step || callback_context_.failure || h < options_.h_min || end_.t + h == end_.t) return false;
    ++retries_;
    positions(y(), extra()) = end_.q;
    velocities(y(), extra()) = end_.v;
    internal_part(y(), extra()) = z_end_;
    require(ARKStepReset(memory(), end_.t, y()));
    restart_renewal();
    require(ARKStepSetInitStep(memory(), h));
    return true;
  }

  // Before the first step: sets end_ and the accelerations there.
  void begin_at(double t) {
    before_.reset();
    end_ = {t, positions(y(), extra()), velocities(y(), extra()), Vector(model_.num_dofs())};
    has_begun_ = false;
    z_end_ = internal_part(y(), extra());
    if (is_split()) {
      initial_acceleration(*explicit_.model, t, explicit_.at_end);
      initial_acceleration(*implicit_.model, t, end_.a);
      end_.a += explicit_.at_end;
      implicit_.at_end = end_.a - explicit_.at_end;
    } else {
      initial_acceleration(model_, t, end_.a);
      only_part().at_end = end_.a;
    }
  }

  // After each step, whose last stage is its end: sets begin_, end_ and the accelerations at end_.
  void take_end(double t) {
    if (has_begun_) before_ = {begin_.t, begin_.q, {}, {}};
    has_begun_ = true;
    std::swap(begin_, end_);
    end_.t = t;
    end_.q = positions(y(), extra());
    end_.v = velocities(y(), extra());
    std::swap(z_begin_, z_end_);
    z_end_ = internal_part(y(), extra());
    end_.a.resize(model_.num_dofs());
    if (is_split()) {
      explicit_.at_end = explicit_.last;
      end_.a = explicit_.last + implicit_.last;
      implicit_.at_end = end_.a - explicit_.at_end;
    } else {
      if (method_.stiffly_accurate) end_.a = stage_acceleration();
      else end_.a = only_part().last;
      only_part().at_end = end_.a;
    }
  }

  // dv/dt at the stage that Newton's method solved last.
  Eigen::Map<Vector> stage_acceleration() const {
    sunrealtype at, gamma;
    N_Vector predicted, stage, stage_derivative, data;
    void* user;
    require(ARKStepGetNonlinearSystemData(memory(), &at, &predicted, &stage, &stage_derivative, &gamma, &data, &user));
    return velocities(stage_derivative, extra());
  }

  int last_order() const override { return main_table().q; }
  long retries() const override { return retries_; }

  int dense_output(double t, N_Vector out) const override {
    auto q = positions(out, extra()), v = velocities(out, extra());
    const bool is_at_end = t == begin_.t || t == end_.t;
    if (!is_at_end && spans_vibrations()) interpolate_slow_motion(t, q, v);
    else orthodyn::interpolate(begin_, end_, t, q, v);
    if (internal_) internal_part(out, extra()) = interpolated_internals(t, q);
    return 0;
  }

  // Whether the last step is far longer than vibrations. The velocities and accelerations at its ends then have errors
  // that are small beside those of vibrations, but would move positions within the step by many times their tolerance.
  bool spans_vibrations() const {
    constexpr double kFarLonger = 10;
    return end_.t - begin_.t > kFarLonger * scales_.position / scales_.velocity;
  }

  // The parabola through the last three ends of steps; a straight line in the first step.
  void interpolate_slow_motion(double t, VectorRef q, VectorRef v) const {
    const double h = end_.t - begin_.t, u = t - begin_.t;
    const Vector slope = (end_.q - begin_.q) / h;
    q = begin_.q + u * slope;
    v = slope;
    if (!before_) return;
    const Vector curvature = (slope - (begin_.q - before_->q) / (begin_.t - before_->t)) / (end_.t - before_->t);
    q += u * (u - h) * curvature;
    v += (2 * u - h) * curvature;
  }

  // The internal variables at a time within the step at which the positions are q. Those that relax more slowly than
  // the step: the cubic Hermite polynomial through the values and rates at both ends. For the others rates would
  // magnify errors by h/tau: they lag behind the strain as with strains of constant rate (advance_of_history()).
  Vector interpolated_internals(double t, const ConstVectorRef& q) const {
    const double h = end_.t - begin_.t, u = t - begin_.t, x = u / h;
    if (!(h > 0)) return z_end_;
    const InternalVariables& internal = internal_->internal();
    const Vector& tau = internal.relaxation_times();
    Vector e0(tau.size()), e1(tau.size()), e(tau.size()), z(tau.size());
    internal.strains(begin_.t, begin_.q, e0);
    internal.strains(end_.t, end_.q, e1);
    internal.strains(t, q, e);
    for (Eigen::Index i = 0; i < z.size(); ++i) {
      const double z0 = z_begin_[i], z1 = z_end_[i];
      if (tau[i] > h) {
        z[i] = z0 + x * x * (3 - 2 * x) * (z1 - z0) + h * x * (1 - x) * (1 - x) * (e0[i] - z0) / tau[i] -
               h * x * x * (1 - x) * (e1[i] - z1) / tau[i];
      } else {
        const auto lag = [&](double after) {  // z - e
          const double decay = std::exp(-after / tau[i]);
          return -tau[i] * (e1[i] - e0[i]) / h * (1 - decay) - decay * (e0[i] - z0);
        };
        z[i] = e[i] + lag(u) + x * (z1 - e1[i] - lag(h));
      }
    }
    return z;
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
      case ARK_TOO_MUCH_ACC: return Reason::diverged;
      case ARK_TOO_CLOSE: return Reason::step_too_small;
      default: return Reason::other;
    }
  }

  std::size_t own_bytes() const override { return 4 * static_cast<std::size_t>(size()) * sizeof(sunrealtype); }

  // Measurements of these settings are in docs/decisions.md.
  void use_newton() {
    void* m = memory();
    require(ARKStepSetNonlinConvCoef(m, options_.nonlinear_coefficient));
    require(ARKStepSetMaxNonlinIters(m, options_.max_newton_iterations));
    model_.traits().smooth ? use_stage_newton() : use_nonsmooth_newton();
    newton_system_->create_first_order(context_, [this] { return gamma(); });
    attach_linear_solver();
    require(newton_system_->is_full() ? ARKStepSetJacFn(m, fill_jacobian) : ARKStepSetLinSysFn(m, linearize));
    // The derivative of a stage is deduced from the solution of the stage. A force evaluated there would multiply the
    // remaining error of Newton's method by the stiffness, and could fail after convergence.
    require(ARKStepSetDeduceImplicitRhs(m, SUNTRUE));
    // Predictor 2 extrapolates early stages with a high order and late stages with a low order. It needs half the
    // iterations of the library's default predictor, the last solution.
    require(ARKStepSetPredictorMethod(m, 2));
  }

  void use_stage_newton() {
    const auto conditions = [this] { return StageNewton::Conditions{statistics_.factorization.count, gamma()}; };
    stage_newton_.emplace(y(), context_, conditions, options_.rtol, newton_system_->least_rate());
    require(ARKStepSetNonlinearSolver(memory(), stage_newton_->get()));
    stage_newton_->replace_test();
  }

  double gamma() const {
    sunrealtype gamma = 0;
    ARKStepGetCurrentGamma(memory(), &gamma);
    return gamma;
  }

  // Callbacks.
  static ArkStep& self(void* user) { return static_cast<ArkStep&>(*static_cast<SundialsIntegrator*>(user)); }

  ARKRhsFn explicit_callback() const { return explicit_.model ? explicit_right_hand_side : nullptr; }
  ARKRhsFn implicit_callback() const { return implicit_.model ? implicit_right_hand_side : nullptr; }

  static int explicit_right_hand_side(sunrealtype t, N_Vector y, N_Vector y_dot, void* user) {
    auto& me = self(user);
    if (me.is_split()) positions(y_dot).setZero();
    return me.is_split() ? me.acceleration(me.explicit_, t, y, velocities(y_dot))
                         : me.all_rates(me.explicit_, t, y, y_dot);
  }

  static int implicit_right_hand_side(sunrealtype t, N_Vector y, N_Vector y_dot, void* user) {
    auto& me = self(user);
    return me.all_rates(me.implicit_, t, y, y_dot);
  }

  int all_rates(ArkPart& part, double t, N_Vector y, N_Vector y_dot) {
    positions(y_dot, extra()) = velocities(y, extra());
    const int flag = acceleration(part, t, y, velocities(y_dot, extra()));
    return flag ? flag : evaluate_internal_rates(t, y, y_dot);
  }

  // Acceleration by one part of the force. At the end of the last step it is known and not evaluated again. The first
  // stage of the next step needs it there, and a failing force would end the integration.
  int acceleration(ArkPart& part, double t, N_Vector y, VectorRef a) {
    bool is_known = false;
    const int thrown = guarded(callback_context_, [&] {
      is_known =
          t == end_.t && model_.space().all(positions(y, extra()) == end_.q && velocities(y, extra()) == end_.v &&
                                            internal_part(y, extra()) == z_end_);
      if (is_known) a = part.at_end;
    });
    if (thrown != 0 || is_known) return thrown;
    const int flag = evaluate_acceleration(*part.model, t, y, a);
    part.last = a;
    return flag;
  }

  static int linearize(sunrealtype t, N_Vector y, N_Vector, SUNMatrix, SUNMatrix, sunbooleantype keep,
                       sunbooleantype* renewed, sunrealtype, void* user, N_Vector, N_Vector, N_Vector) {
    return self(user).newton_system_->linearize(t, y, keep, renewed);
  }

  static int fill_jacobian(sunrealtype t, N_Vector y, N_Vector, SUNMatrix J, void* user, N_Vector, N_Vector, N_Vector) {
    return self(user).newton_system_->fill_jacobian(t, y, J);
  }

  ArkPart explicit_, implicit_;
  long retries_ = 0;               // steps restarted because a force could not be evaluated, since the last (re-)start
  StepEnd begin_, end_;            // ends of the last step
  std::optional<StepEnd> before_;  // begin of the step before it, t and q only; empty after a restart
  bool has_begun_ = false;         // whether a step has been taken since the start
  Vector z_begin_, z_end_;         // internal variables there
  std::optional<StageNewton> stage_newton_;
  std::unique_ptr<void, FreeArkStep> memory_;
};

}  // namespace

std::unique_ptr<Integrator> make_ark_step(const Model& model, ArkMethod method, const Options& options,
                                          const Scales& scales) {
  return std::make_unique<ArkStep>(model, std::move(method), options, scales);
}

}  // namespace orthodyn::sundials
