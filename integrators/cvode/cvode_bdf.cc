// CVODE's BDF (Hindmarsh et al. 2005): variable order 1-5, variable step, Newton.
#include <cvode/cvode.h>
#include <cvode/cvode_ls.h>
#include <fmt/format.h>

#include <cmath>

#include "integrators/sundials/callbacks.h"
#include "integrators/sundials/full_jacobian.h"
#include "integrators/sundials/multistep.h"
#include "integrators/sundials/plug.h"
#include "integrators/sundials/reduced_solve.h"

namespace orthodyn::sundials {
namespace {

struct CvodeMemory {
  void operator()(void* memory) const { CVodeFree(&memory); }
};

class CvodeBdf : public Integrator {
 public:
  CvodeBdf(const Model& model, const MultistepSettings& settings)
      : model_(model), settings_(settings), n_(model.num_dofs()), y_(make_vector(2 * n_, context_)),
        momentum_(n_) {
    if (settings.full && !model.traits().lumped_mass)
      throw ConfigError("linear_solver klu_full under cvode_bdf needs `mass: lumped` (the inverse of a "
                        "consistent mass is dense); use ida_bdf, or klu or cholmod");
    memory_.reset(CVodeCreate(CV_BDF, context_));
    if (!memory_) throw RunError("CVODE could not be created");
    if (settings.full) full_.emplace(model);
    else reduced_.emplace(model, settings.options.linear_solver, settings.tangent(), statistics_);
  }

  void start(const State& state) override {
    positions(y_.get()) = state.q;
    velocities(y_.get()) = state.v;
    if (started_) {
      require(CVodeReInit(memory_.get(), state.t, y_.get()));
      carry_over();
      return;
    }
    initialise(state.t);
    started_ = true;
  }

  StepInfo step(double t_stop) override {
    if (statistics_.steps >= settings_.options.max_steps)
      throw RunError(fmt::format("cvode_bdf gave up at t = {:.6g} s after {} steps (max_steps); raise "
                                 "integrator.max_steps or integrator.rtol",
                                 t_, statistics_.steps));
    require(CVodeSetStopTime(memory_.get(), t_stop));
    sunrealtype reached = t_;
    const int flag = CVode(memory_.get(), t_stop, y_.get(), &reached, CV_ONE_STEP);
    update_statistics();
    if (flag < 0) fail(flag);
    t_ = reached;
    StepInfo info{t_, 0, 0};
    sunrealtype h = 0;
    CVodeGetLastStep(memory_.get(), &h);
    CVodeGetLastOrder(memory_.get(), &info.order);
    info.h = h;
    return info;
  }

  void interpolate(double t, State& out) const override {
    const auto dky = make_vector(2 * n_, context_);
    if (CVodeGetDky(memory_.get(), t, 0, dky.get()) != CV_SUCCESS)
      throw RunError(fmt::format("cvode_bdf cannot interpolate at t = {:.17g} s: {}", t, border_.library_message));
    out.t = t;
    out.q = positions(dky.get());
    out.v = velocities(dky.get());
  }

  const Statistics& statistics() const override { return statistics_; }
  std::size_t factor_bytes() const override { return reduced_ ? reduced_->factor_bytes() : 0; }

  std::size_t bytes() const override {
    long reals = 0, integers = 0;
    CVodeGetWorkSpace(memory_.get(), &reals, &integers);
    return static_cast<std::size_t>(reals) * sizeof(sunrealtype) + (reduced_ ? reduced_->bytes() : 0);
  }

  std::vector<std::pair<std::string, std::string>> decisions() const override {
    auto all = settings_.decisions();
    all.emplace_back("linear_solver", settings_.options.linear_solver +
                                          (reduced_ ? " (" + reduced_->description() + ")" : ""));
    return all;
  }

 private:
  static CvodeBdf& self(void* user) { return *static_cast<CvodeBdf*>(user); }

  void initialise(double t) {
    void* m = memory_.get();
    ORTHODYN_CAPTURE_ERRORS(CVodeSetErrHandlerFn, context_, m, &border_.library_message);
    require(CVodeInit(m, &CvodeBdf::rhs, t, y_.get()));
    t_ = t;
    require(CVodeSetUserData(m, this));
    require(CVodeWFtolerances(m, [](N_Vector, N_Vector weights, void* user) {
      self(user).settings_.set_weights(weights);
      return 0;
    }));
    const auto& o = settings_.options;
    require(CVodeSetMaxOrd(m, settings_.max_order));
    require(CVodeSetNonlinConvCoef(m, o.nonlinear_coefficient));
    require(CVodeSetMaxNonlinIters(m, o.max_newton_iterations));
    if (o.h0) require(CVodeSetInitStep(m, *o.h0));
    if (o.h_max) require(CVodeSetMaxStep(m, *o.h_max));
    if (o.h_min > 0) require(CVodeSetMinStep(m, o.h_min));
    settings_.full ? attach_full() : attach_reduced();
    require(CVodeSetDeltaGammaMaxLSetup(m, 0.5));
  }

  void attach_reduced() {
    matrix_ = make_matrix_plug(context_);
    functions_.setup = [this] {
      int status = 0;
      const int thrown = guarded(border_, [&] {
        sunrealtype gamma = 0;
        CVodeGetCurrentGamma(memory_.get(), &gamma);
        if (!reduced_->factor(gamma)) status = 1;
      });
      return thrown ? thrown : status;
    };
    functions_.solve = [this](N_Vector x, N_Vector b) {
      return guarded(border_, [&] {
        model_.multiply_mass(velocities(b), momentum_);
        reduced_->solve(positions(b), momentum_, positions(x), velocities(x));
      });
    };
    solver_ = make_solver_plug(functions_, context_);
    require(CVodeSetLinearSolver(memory_.get(), solver_.get(), matrix_.get()));
    require(CVodeSetLinSysFn(memory_.get(), [](sunrealtype t, N_Vector y, N_Vector, SUNMatrix, sunbooleantype jok,
                                               sunbooleantype* jcur, sunrealtype, void* user, N_Vector, N_Vector,
                                               N_Vector) {
      auto& me = self(user);
      *jcur = !jok;
      return guarded(me.border_, [&] {
        if (!jok) me.reduced_->linearize(t, positions(y), velocities(y));
      });
    }));
  }

  void attach_full() {
    matrix_ = full_->make_matrix(context_);
    solver_ = make_klu(matrix_.get(), context_);
    require(CVodeSetLinearSolver(memory_.get(), solver_.get(), matrix_.get()));
    require(CVodeSetJacFn(memory_.get(), [](sunrealtype t, N_Vector y, N_Vector, SUNMatrix J, void* user, N_Vector,
                                            N_Vector, N_Vector) {
      auto& me = self(user);
      return guarded(me.border_, [&] {
        const Measure measure(me.statistics_.tangent);
        me.model_.linearize(t, positions(y), velocities(y), me.settings_.tangent(), me.linearization_);
        me.full_->fill_cvode(me.linearization_, J);
      });
    }));
  }

  static int rhs(sunrealtype t, N_Vector y, N_Vector y_dot, void* user) {
    auto& me = self(user);
    return guarded(me.border_, [&] {
      const Measure measure(me.statistics_.force);
      positions(y_dot) = velocities(y);
      me.model_.force(t, positions(y), velocities(y), velocities(y_dot));
      require_finite(velocities(y_dot));
      me.model_.solve_mass(velocities(y_dot));
    });
  }

  // CVodeReInit sets the library's counters to zero: keep what was counted before it.
  void carry_over() { before_ = statistics_; }

  void update_statistics() {
    long steps = 0, error_failures = 0, iterations = 0, convergence_failures = 0, setups = 0;
    void* m = memory_.get();
    CVodeGetNumSteps(m, &steps);
    CVodeGetNumErrTestFails(m, &error_failures);
    CVodeGetNumNonlinSolvIters(m, &iterations);
    CVodeGetNumNonlinSolvConvFails(m, &convergence_failures);
    CVodeGetNumLinSolvSetups(m, &setups);
    auto& s = statistics_;
    s.steps = before_.steps + steps;
    s.error_test_failures = before_.error_test_failures + error_failures;
    s.convergence_failures = before_.convergence_failures + convergence_failures;
    s.rejected_steps = s.error_test_failures + s.convergence_failures;
    s.newton_iterations = before_.newton_iterations + iterations;
    if (settings_.full) {
      s.factorization.count = before_.factorization.count + setups;
      s.solve.count = before_.solve.count + iterations;
    }
  }

  void require(int flag) const {
    if (flag < 0) throw RunError("CVODE refused its set-up: " + border_.library_message);
  }

  [[noreturn]] void fail(int flag);

  const Model& model_;
  MultistepSettings settings_;
  Statistics statistics_, before_;
  Border border_;
  Eigen::Index n_;
  Context context_;
  OwnedVector y_;
  Vector momentum_;
  std::optional<ReducedSolve> reduced_;
  std::optional<FullJacobian> full_;
  Linearization linearization_;
  SolverFunctions functions_;
  OwnedMatrix matrix_;
  OwnedSolver solver_;
  std::unique_ptr<void, CvodeMemory> memory_;
  double t_ = 0;
  bool started_ = false;
};

void CvodeBdf::fail(int flag) {
  if (border_.failure) std::rethrow_exception(border_.failure);
  sunrealtype h = 0;
  CVodeGetCurrentStep(memory_.get(), &h);
  const std::string where = fmt::format("cvode_bdf stopped at t = {:.6g} s, step {:.3g} s: ", t_, h);
  const std::string cause = border_.recoverable_cause.empty() ? "" : " (" + border_.recoverable_cause + ")";
  switch (flag) {
    case CV_ERR_FAILURE:
      throw RunError(where + "the error test keeps failing" + cause +
                     "; raise integrator.rtol, lower integrator.h_min, or look for a kink in the loads");
    case CV_CONV_FAILURE:
    case CV_LSETUP_FAIL:
    case CV_NLS_FAIL:
      throw RunError(where + "Newton's method does not converge at the smallest step" + cause +
                     "; set integrator.gauss_newton: true, lower rtol or h_min, or check for inverted elements");
    case CV_RHSFUNC_FAIL:
    case CV_FIRST_RHSFUNC_ERR:
    case CV_REPTD_RHSFUNC_ERR:
    case CV_UNREC_RHSFUNC_ERR:
      throw RunError(where + "the force cannot be evaluated" + cause + "; lower integrator.h_max or check the loads");
    case CV_TOO_CLOSE:
      throw RunError(where + "the time interval is too short for the resolution of time");
    default:
      throw RunError(where + border_.library_message + fmt::format(" (CVODE flag {})", flag));
  }
}

class CvodeBdfChoice : public IntegratorChoice, public MultistepOptions {
 public:
  static const Spec<CvodeBdfChoice>& spec() {
    static const auto s = MultistepOptions::spec_for<CvodeBdfChoice>();
    return s;
  }
  std::unique_ptr<Integrator> make(const Model& model, const std::function<Scales()>& estimate) const override {
    return std::make_unique<CvodeBdf>(model, MultistepSettings::complete(*this, model, estimate));
  }
};

const bool registered = Registry<IntegratorChoice>::add<CvodeBdfChoice>(
    "cvode_bdf", "CVODE: backward differentiation formulas of order 1-5, adaptive, implicit.");

}  // namespace
}  // namespace orthodyn::sundials
