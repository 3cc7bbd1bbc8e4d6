// IDA's BDF on the implicit system F = (q' - v, M v' - f) = 0 (Hindmarsh et al. 2005): fixed leading
// coefficient, variable order 1-5. A consistent mass costs it no solve.
#include <ida/ida.h>
#include <ida/ida_ls.h>

#include "integrators/finite_force.h"
#include "integrators/sundials/multistep.h"
#include "integrators/sundials/newton_at_kinks.h"
#include "integrators/sundials/sundials_integrator.h"

namespace orthodyn::sundials {
namespace {

struct FreeIda {
  void operator()(void* memory) const { IDAFree(&memory); }
};

class IdaBdf : public SundialsIntegrator {
 public:
  IdaBdf(const Model& model, const MultistepSettings& settings)
      : SundialsIntegrator("ida_bdf", model, settings),
        max_order_(settings.max_order),
        y_dot_(make_vector(size(), context_, model.ranks())),
        memory_(IDACreate(context_)) {
    if (!memory_) throw RunError("IDA could not be created");
  }

 protected:
  void initialise(double t) override {
    void* m = memory_.get();
    make_consistent(t);
    ORTHODYN_CAPTURE_ERRORS(IDASetErrHandlerFn, context_, m, &callback_context_.message);
    require(IDAInit(m, residual, t, y(), y_dot_.get()));
    require(IDASetUserData(m, this));
    require(IDAWFtolerances(m, [](N_Vector, N_Vector weights, void* user) {
      self(user).settings_.set_weights(weights);
      return 0;
    }));
    const auto& o = settings_.options;
    require(IDASetMaxOrd(m, max_order_));
    require(IDASetNonlinConvCoef(m, o.nonlinear_coefficient));
    if (o.h0) require(IDASetInitStep(m, *o.h0));
    if (o.h_max) require(IDASetMaxStep(m, *o.h_max));
    if (o.h_min > 0) require(IDASetMinStep(m, o.h_min));
    if (!model_.traits().smooth) {
      newton_.emplace(settings_.options.rtol, y(), context_);
      require(IDASetNonlinearSolver(m, newton_->get()));
      newton_->replace_test();
    }
    require(IDASetMaxNonlinIters(m, o.max_newton_iterations));
    settings_.full ? attach_full() : attach_reduced();
  }

  void reinitialise(double t) override {
    make_consistent(t);
    require(IDAReInit(memory_.get(), t, y(), y_dot_.get()));
  }

  int advance(double t_stop, double& t) override {
    require(IDASetStopTime(memory_.get(), t_stop));
    return IDASolve(memory_.get(), t_stop, &t, y(), y_dot_.get(), IDA_ONE_STEP);
  }

  StepInfo last_step() const override {
    StepInfo info;
    IDAGetLastStep(memory_.get(), &info.h);
    IDAGetLastOrder(memory_.get(), &info.order);
    return info;
  }

  double current_step() const override {
    sunrealtype h = 0;
    IDAGetCurrentStep(memory_.get(), &h);
    return h;
  }

  int dense_output(double t, N_Vector out) const override { return IDAGetDky(memory_.get(), t, 0, out); }

  Counters counters() const override {
    Counters c;
    void* m = memory_.get();
    IDAGetNumSteps(m, &c.steps);
    IDAGetNumErrTestFails(m, &c.error_test_failures);
    IDAGetNumStepSolveFails(m, &c.convergence_failures);
    IDAGetNumNonlinSolvIters(m, &c.newton_iterations);
    return c;
  }

  Reason classify(int flag) const override {
    switch (flag) {
      case IDA_ERR_FAIL: return Reason::error_test;
      case IDA_CONV_FAIL:
      case IDA_LSETUP_FAIL:
      case IDA_NLS_FAIL: return Reason::newton;
      case IDA_RES_FAIL:
      case IDA_REP_RES_ERR:
      case IDA_FIRST_RES_FAIL: return Reason::force;
      default: return Reason::other;
    }
  }

  std::size_t workspace_bytes() const override {
    long reals = 0, integers = 0;
    IDAGetWorkSpace(memory_.get(), &reals, &integers);
    return static_cast<std::size_t>(reals) * sizeof(sunrealtype);
  }

 private:
  static IdaBdf& self(void* user) { return *static_cast<IdaBdf*>(user); }

  // q' = v, v' = M^-1 f: initial conditions that satisfy F = 0 by construction.
  void make_consistent(double t) {
    positions(y_dot_.get()) = velocities(y());
    initial_acceleration(model_, t, velocities(y_dot_.get()));
  }

  static int residual(sunrealtype t, N_Vector y, N_Vector y_dot, N_Vector r, void* user) {
    auto& me = self(user);
    return guarded(me.callback_context_, [&] {
      const Measure measure(me.statistics_.force);
      positions(r) = positions(y_dot) - velocities(y);
      me.model_.force(t, positions(y), velocities(y), velocities(r));
      require_finite(me.model_, velocities(r));
      me.model_.multiply_mass(velocities(y_dot), me.momentum_);
      velocities(r) = me.momentum_ - velocities(r);
    });
  }

  void attach_reduced() {
    make_reduced_solver([this] { return gamma_; },
                        [this](N_Vector x, N_Vector b) {
                          momentum_ = gamma_ * velocities(b);
                          positions(x) = gamma_ * positions(b);
                          reduced_->solve(positions(x), momentum_, positions(x), velocities(x));
                        });
    require(IDASetLinearSolver(memory_.get(), solver_.get(), matrix_.get()));
    require(IDASetJacFn(memory_.get(), [](sunrealtype t, sunrealtype cj, N_Vector y, N_Vector, N_Vector, SUNMatrix,
                                          void* user, N_Vector, N_Vector, N_Vector) {
      auto& me = self(user);
      return guarded(me.callback_context_, [&] {
        me.gamma_ = 1 / cj;
        me.reduced_->linearize(t, positions(y), velocities(y));
      });
    }));
  }

  void attach_full() {
    make_full_solver();
    require(IDASetLinearSolver(memory_.get(), solver_.get(), matrix_.get()));
    require(IDASetJacFn(memory_.get(), [](sunrealtype t, sunrealtype cj, N_Vector y, N_Vector, N_Vector, SUNMatrix J,
                                          void* user, N_Vector, N_Vector, N_Vector) {
      auto& me = self(user);
      return guarded(me.callback_context_, [&] {
        me.linearize_full(t, y);
        me.full_->fill_ida(cj, me.linearization_, J);
      });
    }));
  }

  int max_order_;
  OwnedVector y_dot_;
  double gamma_ = 0;  // 1/cj of the last set-up
  std::optional<NewtonAtKinks> newton_;
  std::unique_ptr<void, FreeIda> memory_;
};

class IdaBdfChoice : public SettableChoice<IdaBdfChoice>, public MultistepOptions {
 public:
  static const Spec<IdaBdfChoice>& spec() {
    static const auto s = MultistepOptions::spec_for<IdaBdfChoice>();
    return s;
  }
  static MethodFacts facts() {
    return method_facts("1-5, variable", "as cvode_bdf, with a fixed leading coefficient",
                        "linear invariants (momentum); energy of oscillations is damped",
                        "Hindmarsh et al., ACM TOMS 31, 2005; Brenan, Campbell & Petzold 1996");
  }
  bool runs_on_ranks() const override { return true; }
  std::unique_ptr<Integrator> make(const Model& model, const Task& task) const override {
    return std::make_unique<IdaBdf>(model, MultistepSettings::complete(*this, model, task));
  }
};

const bool ida_bdf_registered = Registry<IntegratorChoice>::add<IdaBdfChoice>(
    "ida_bdf", "IDA: backward differentiation formulas of order 1-5 on the implicit system, adaptive.");

}  // namespace
}  // namespace orthodyn::sundials
