// IDA's BDF on the implicit system F = (q' - v, M v' - f) = 0 (Hindmarsh et al. 2005): fixed leading
// coefficient, variable order 1-5. A consistent mass costs it no solve.
#include <fmt/format.h>
#include <ida/ida.h>
#include <ida/ida_ls.h>

#include "integrators/sundials/callbacks.h"
#include "integrators/sundials/full_jacobian.h"
#include "integrators/sundials/multistep.h"
#include "integrators/sundials/plug.h"
#include "integrators/sundials/reduced_solve.h"

namespace orthodyn::sundials {
namespace {

struct IdaMemory {
  void operator()(void* memory) const { IDAFree(&memory); }
};

class IdaBdf : public Integrator {
 public:
  IdaBdf(const Model& model, const MultistepSettings& settings)
      : model_(model), settings_(settings), n_(model.num_dofs()), y_(make_vector(2 * n_, context_)),
        y_dot_(make_vector(2 * n_, context_)), momentum_(n_) {
    memory_.reset(IDACreate(context_));
    if (!memory_) throw RunError("IDA could not be created");
    if (settings.full) full_.emplace(model);
    else reduced_.emplace(model, settings.options.linear_solver, settings.tangent(), statistics_);
  }

  void start(const State& state) override {
    positions(y_.get()) = state.q;
    velocities(y_.get()) = state.v;
    // Consistent by construction: q' = v, v' = M^-1 f.
    positions(y_dot_.get()) = state.v;
    model_.force(state.t, state.q, state.v, velocities(y_dot_.get()));
    model_.solve_mass(velocities(y_dot_.get()));
    if (started_) {
      require(IDAReInit(memory_.get(), state.t, y_.get(), y_dot_.get()));
      before_ = statistics_;  // the library's counters go back to zero
      return;
    }
    initialise(state.t);
    started_ = true;
  }

  StepInfo step(double t_stop) override {
    if (statistics_.steps >= settings_.options.max_steps)
      throw RunError(fmt::format("ida_bdf gave up at t = {:.6g} s after {} steps (max_steps); raise "
                                 "integrator.max_steps or integrator.rtol",
                                 t_, statistics_.steps));
    require(IDASetStopTime(memory_.get(), t_stop));
    sunrealtype reached = t_;
    const int flag = IDASolve(memory_.get(), t_stop, &reached, y_.get(), y_dot_.get(), IDA_ONE_STEP);
    update_statistics();
    if (flag < 0) fail(flag);
    t_ = reached;
    StepInfo info{t_, 0, 0};
    sunrealtype h = 0;
    IDAGetLastStep(memory_.get(), &h);
    IDAGetLastOrder(memory_.get(), &info.order);
    info.h = h;
    return info;
  }

  void interpolate(double t, State& out) const override {
    const auto dky = make_vector(2 * n_, context_);
    if (IDAGetDky(memory_.get(), t, 0, dky.get()) != IDA_SUCCESS)
      throw RunError(fmt::format("ida_bdf cannot interpolate at t = {:.17g} s: {}", t, border_.library_message));
    out.t = t;
    out.q = positions(dky.get());
    out.v = velocities(dky.get());
  }

  const Statistics& statistics() const override { return statistics_; }
  std::size_t factor_bytes() const override { return reduced_ ? reduced_->factor_bytes() : 0; }

  std::size_t bytes() const override {
    long reals = 0, integers = 0;
    IDAGetWorkSpace(memory_.get(), &reals, &integers);
    return static_cast<std::size_t>(reals) * sizeof(sunrealtype) + (reduced_ ? reduced_->bytes() : 0);
  }

  std::vector<std::pair<std::string, std::string>> decisions() const override {
    auto all = settings_.decisions();
    all.emplace_back("linear_solver", settings_.options.linear_solver +
                                          (reduced_ ? " (" + reduced_->description() + ")" : ""));
    return all;
  }

 private:
  static IdaBdf& self(void* user) { return *static_cast<IdaBdf*>(user); }

  void initialise(double t) {
    void* m = memory_.get();
    ORTHODYN_CAPTURE_ERRORS(IDASetErrHandlerFn, context_, m, &border_.library_message);
    require(IDAInit(m, &IdaBdf::residual, t, y_.get(), y_dot_.get()));
    t_ = t;
    require(IDASetUserData(m, this));
    require(IDAWFtolerances(m, [](N_Vector, N_Vector weights, void* user) {
      self(user).settings_.set_weights(weights);
      return 0;
    }));
    const auto& o = settings_.options;
    require(IDASetMaxOrd(m, settings_.max_order));
    require(IDASetNonlinConvCoef(m, o.nonlinear_coefficient));
    require(IDASetMaxNonlinIters(m, o.max_newton_iterations));
    if (o.h0) require(IDASetInitStep(m, *o.h0));
    if (o.h_max) require(IDASetMaxStep(m, *o.h_max));
    if (o.h_min > 0) require(IDASetMinStep(m, o.h_min));
    settings_.full ? attach_full() : attach_reduced();
  }

  void attach_reduced() {
    matrix_ = make_matrix_plug(context_);
    functions_.setup = [this] {
      int status = 0;
      const int thrown = guarded(border_, [&] { if (!reduced_->factor(gamma_)) status = 1; });
      return thrown ? thrown : status;
    };
    functions_.solve = [this](N_Vector x, N_Vector b) {
      return guarded(border_, [&] {
        momentum_ = gamma_ * velocities(b);
        positions(x) = gamma_ * positions(b);
        reduced_->solve(positions(x), momentum_, positions(x), velocities(x));
      });
    };
    solver_ = make_solver_plug(functions_, context_);
    require(IDASetLinearSolver(memory_.get(), solver_.get(), matrix_.get()));
    require(IDASetJacFn(memory_.get(), [](sunrealtype t, sunrealtype cj, N_Vector y, N_Vector, N_Vector, SUNMatrix,
                                          void* user, N_Vector, N_Vector, N_Vector) {
      auto& me = self(user);
      return guarded(me.border_, [&] {
        me.gamma_ = 1 / cj;
        me.reduced_->linearize(t, positions(y), velocities(y));
      });
    }));
  }

  void attach_full() {
    matrix_ = full_->make_matrix(context_);
    solver_ = make_klu(matrix_.get(), context_);
    require(IDASetLinearSolver(memory_.get(), solver_.get(), matrix_.get()));
    require(IDASetJacFn(memory_.get(), [](sunrealtype t, sunrealtype cj, N_Vector y, N_Vector, N_Vector, SUNMatrix J,
                                          void* user, N_Vector, N_Vector, N_Vector) {
      auto& me = self(user);
      return guarded(me.border_, [&] {
        const Measure measure(me.statistics_.tangent);
        me.model_.linearize(t, positions(y), velocities(y), me.settings_.tangent(), me.linearization_);
        me.full_->fill_ida(cj, me.linearization_, J);
      });
    }));
  }

  static int residual(sunrealtype t, N_Vector y, N_Vector y_dot, N_Vector r, void* user) {
    auto& me = self(user);
    return guarded(me.border_, [&] {
      const Measure measure(me.statistics_.force);
      positions(r) = positions(y_dot) - velocities(y);
      me.model_.force(t, positions(y), velocities(y), velocities(r));
      require_finite(velocities(r));
      me.model_.multiply_mass(velocities(y_dot), me.momentum_);
      velocities(r) = me.momentum_ - velocities(r);
    });
  }

  void update_statistics() {
    long steps = 0, error_failures = 0, iterations = 0, convergence_failures = 0, setups = 0;
    void* m = memory_.get();
    IDAGetNumSteps(m, &steps);
    IDAGetNumErrTestFails(m, &error_failures);
    IDAGetNumNonlinSolvIters(m, &iterations);
    IDAGetNumNonlinSolvConvFails(m, &convergence_failures);
    IDAGetNumLinSolvSetups(m, &setups);
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
    if (flag < 0) throw RunError("IDA refused its set-up: " + border_.library_message);
  }

  [[noreturn]] void fail(int flag);

  const Model& model_;
  MultistepSettings settings_;
  Statistics statistics_, before_;
  Border border_;
  Eigen::Index n_;
  Context context_;
  OwnedVector y_, y_dot_;
  Vector momentum_;
  std::optional<ReducedSolve> reduced_;
  std::optional<FullJacobian> full_;
  Linearization linearization_;
  SolverFunctions functions_;
  OwnedMatrix matrix_;
  OwnedSolver solver_;
  std::unique_ptr<void, IdaMemory> memory_;
  double t_ = 0, gamma_ = 0;
  bool started_ = false;
};

void IdaBdf::fail(int flag) {
  if (border_.failure) std::rethrow_exception(border_.failure);
  sunrealtype h = 0;
  IDAGetCurrentStep(memory_.get(), &h);
  const std::string where = fmt::format("ida_bdf stopped at t = {:.6g} s, step {:.3g} s: ", t_, h);
  const std::string cause = border_.recoverable_cause.empty() ? "" : " (" + border_.recoverable_cause + ")";
  switch (flag) {
    case IDA_ERR_FAIL:
      throw RunError(where + "the error test keeps failing" + cause +
                     "; raise integrator.rtol, lower integrator.h_min, or look for a kink in the loads");
    case IDA_CONV_FAIL:
    case IDA_LSETUP_FAIL:
    case IDA_NLS_FAIL:
      throw RunError(where + "Newton's method does not converge at the smallest step" + cause +
                     "; set integrator.gauss_newton: true, lower rtol or h_min, or check for inverted elements");
    case IDA_RES_FAIL:
    case IDA_REP_RES_ERR:
    case IDA_FIRST_RES_FAIL:
      throw RunError(where + "the force cannot be evaluated" + cause + "; lower integrator.h_max or check the loads");
    default:
      throw RunError(where + border_.library_message + fmt::format(" (IDA flag {})", flag));
  }
}

class IdaBdfChoice : public IntegratorChoice, public MultistepOptions {
 public:
  static const Spec<IdaBdfChoice>& spec() {
    static const auto s = MultistepOptions::spec_for<IdaBdfChoice>();
    return s;
  }
  std::unique_ptr<Integrator> make(const Model& model, const std::function<Scales()>& estimate) const override {
    return std::make_unique<IdaBdf>(model, MultistepSettings::complete(*this, model, estimate));
  }
};

const bool registered = Registry<IntegratorChoice>::add<IdaBdfChoice>(
    "ida_bdf", "IDA: backward differentiation formulas of order 1-5 on the implicit system, adaptive.");

}  // namespace
}  // namespace orthodyn::sundials
