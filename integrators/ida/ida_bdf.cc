// IDA's BDF on the implicit system F = (q' - v, M v' - f) = 0 (Hindmarsh et al. 2005): fixed leading coefficient,
// variable order 1-5. Constraints make the system one of index 2 (constraint_solve.h). With a consistent mass, steps
// solve no systems with M alone. The library is IDAS, which is IDA with forward sensitivities.
#include <fmt/format.h>
#include <idas/idas.h>
#include <idas/idas_ls.h>

#include <algorithm>

#include "integrators/run_checks.h"
#include "integrators/sundials/bdf_order.h"
#include "integrators/sundials/forward_sensitivities.h"
#include "integrators/sundials/sundials_integrator.h"
#include "lib/ode/constraints_at.h"

namespace orthodyn::sundials {
namespace {

struct FreeIda {
  void operator()(void* memory) const { IDAFree(&memory); }
};

constexpr LibraryCalls kIdaCalls = [] {
  LibraryCalls calls = ORTHODYN_LIBRARY_CALLS(IDA);
  calls.algebraic = true;
  return calls;
}();

class IdaBdf final : public SundialsIntegrator {
 public:
  IdaBdf(const Model& model, const Options& options, const Scales& scales, int max_order,
         SensitivityEquations* sensitivities, bool simultaneous)
      : SundialsIntegrator("ida_bdf", kIdaCalls, model, options, scales, true),
        max_order_(max_order),
        corrector_(simultaneous ? IDA_SIMULTANEOUS : IDA_STAGGERED),
        momentum_(model.num_dofs()),
        y_dot_(make_vector(size(), context_, model.ranks())),
        memory_(IDACreate(context_)) {
    if (!memory_) throw RunError("IDA could not be created");
    decisions_.emplace_back("max_order", std::to_string(max_order));
    if (sensitivities) sensitivities_.emplace(*sensitivities, model, y(), callback_context_, statistics_);
  }

  void interpolate_sensitivity(int i, double t, State& out) const override {
    const OwnedVector dense(N_VClone(y()));
    if (IDAGetSensDky1(memory(), t, 0, i, dense.get()) < 0)
      throw RunError(
          fmt::format("IDAS cannot interpolate the sensitivities at t = {:.17g} s: {}", t, callback_context_.message));
    out = ForwardSensitivities::state(t, dense.get());
  }

 private:
  void* memory() const override { return memory_.get(); }

  void initialise(double t) override {
    void* m = memory();
    make_consistent(t);
    ORTHODYN_CAPTURE_ERRORS(IDASetErrHandlerFn, context_, m, &callback_context_.message);
    require(IDAInit(m, residual, t, y(), y_dot_.get()));
    set_error_weights();
    require(IDASetMaxOrd(m, max_order_));
    require(IDASetNonlinConvCoef(m, nonlinear_coefficient()));
    set_step_limits();
    if (model_.constraints()) exclude_multipliers();
    if (!model_.traits().smooth) use_nonsmooth_newton();
    require(IDASetMaxNonlinIters(m, options_.max_newton_iterations));
    newton_system_->create_residual(context_);
    attach_linear_solver();
    require(IDASetJacFn(m, linearize));
    if (sensitivities_) start_sensitivities(t);
  }

  // Newton's method stops at this multiple of the tolerance. With internal variables, iterations that IDA takes for
  // converged leave torques (docs/decisions.md); below 1e-15 of the unknowns, rounding ends the iteration.
  double nonlinear_coefficient() const {
    constexpr double kWithInternals = 1e-5, kRounding = 1e-15;
    const double usual = options_.nonlinear_coefficient;
    return internal_ ? std::min(usual, std::max(kWithInternals * usual, kRounding / options_.rtol)) : usual;
  }

  void start_sensitivities(double t) {
    void* m = memory();
    sensitivities_->start();
    sensitivities_->make_consistent(t, y(), y_dot_.get());
    require(IDASensInit(m, sensitivities_->count(), corrector_, sensitivity_residual, sensitivities_->values(),
                        sensitivities_->derivatives()));
    require(IDASetSensParams(m, nullptr, sensitivities_->scales().data(), nullptr));
    require(IDASensSVtolerances(m, options_.rtol, sensitivities_->tolerances(options_.rtol, scales_)));
    require(IDASetSensErrCon(m, 1));
    // The iteration of the simultaneous corrector exists only now.
    if (corrector_ == IDA_SIMULTANEOUS) require(IDASetMaxNonlinIters(m, options_.max_newton_iterations));
  }

  // Sensitivities are continuous at t, the end of the last step.
  void reinitialise(double t) override {
    if (sensitivities_) require(IDAGetSensDky(memory(), t, 0, sensitivities_->values()));
    make_consistent(t);
    require(IDAReInit(memory(), t, y(), y_dot_.get()));
    if (!sensitivities_) return;
    sensitivities_->make_consistent(t, y(), y_dot_.get());
    require(IDASensReInit(memory(), corrector_, sensitivities_->values(), sensitivities_->derivatives()));
  }

  int advance(double t_stop, double& t) override {
    require(IDASetStopTime(memory(), t_stop));
    return IDASolve(memory(), t_stop, &t, y(), y_dot_.get(), IDA_ONE_STEP);
  }

  int last_order() const override {
    int order = 0;
    IDAGetLastOrder(memory(), &order);
    return order;
  }

  int dense_output(double t, N_Vector out) const override { return IDAGetDky(memory(), t, 0, out); }

  Reason classify(int flag) const override {
    switch (flag) {
      case IDA_ERR_FAIL: return Reason::error_test;
      case IDA_CONV_FAIL:
      case IDA_LSETUP_FAIL:
      case IDA_NLS_FAIL: return Reason::newton;
      case IDA_RES_FAIL:
      case IDA_SRES_FAIL:
      case IDA_REP_SRES_ERR:
      case IDA_REP_RES_ERR:
      case IDA_FIRST_RES_FAIL: return Reason::force;
      default: return Reason::other;
    }
  }

  // Sets q' = v and v' = M^-1 f, so that the initial values satisfy F = 0. With constraints, removes the velocities
  // that violate them, as round-off and kinks of loads leave them, and sets lambda, mu = 0, and the accelerations with
  // the forces of the constraints.
  void make_consistent(double t) {
    auto v = velocities(y(), extra()), a = velocities(y_dot_.get(), extra());
    std::optional<ConstraintsAt> at;
    if (model_.constraints()) at.emplace(model_, t, positions(y(), extra()));
    if (at) at->fit(v);
    positions(y_dot_.get(), extra()) = v;
    initial_acceleration(model_, t, a);
    if (at) {
      velocity_multipliers(y(), extra()) = at->multipliers(v, a);
      position_multipliers(y(), extra()).setZero();
      velocity_multipliers(y_dot_.get(), extra()).setZero();
      position_multipliers(y_dot_.get(), extra()).setZero();
    }
    evaluate_internal_rates(t, y(), y_dot_.get());
  }

  // Multipliers have no derivatives in the equations.
  void exclude_multipliers() {
    const OwnedVector differential(N_VClone(y()));
    N_VConst(1, differential.get());
    velocity_multipliers(differential.get(), extra()).setZero();
    position_multipliers(differential.get(), extra()).setZero();
    require(IDASetId(memory(), differential.get()));
    require(IDASetSuppressAlg(memory(), SUNTRUE));
  }

  // Callbacks.
  static IdaBdf& self(void* user) { return static_cast<IdaBdf&>(*static_cast<SundialsIntegrator*>(user)); }

  static int residual(sunrealtype t, N_Vector y, N_Vector y_dot, N_Vector r, void* user) {
    auto& me = self(user);
    const Extra m = me.extra();
    const int flag = me.evaluate_internal_rates(t, y, r);
    return flag ? flag : guarded(me.callback_context_, [&] {
      const Measure measure(me.statistics_.force);
      positions(r, m) = positions(y_dot, m) - velocities(y, m);
      me.with_internals(me.model_, y).force(t, positions(y, m), velocities(y, m), velocities(r, m));
      require_finite(me.model_, velocities(r, m));
      me.model_.multiply_mass(velocities(y_dot, m), me.momentum_);
      velocities(r, m) = me.momentum_ - velocities(r, m);
      internal_part(r, m) = internal_part(y_dot, m) - internal_part(r, m);
      if (const Constraints* constraints = me.model_.constraints()) {
        const Eigen::SparseMatrix<double> G = constraints->jacobian(t, positions(y, m));
        positions(r, m) += G * position_multipliers(y, m);
        velocities(r, m) += G * velocity_multipliers(y, m);
        constraints->rates(t, positions(y, m), velocities(y, m), velocity_multipliers(r, m));
        constraints->values(t, positions(y, m), position_multipliers(r, m));
      }
    });
  }

  static int linearize(sunrealtype t, sunrealtype cj, N_Vector y, N_Vector, N_Vector, SUNMatrix J, void* user, N_Vector,
                       N_Vector, N_Vector) {
    return self(user).newton_system_->linearize_residual(t, cj, y, J);
  }

  static int sensitivity_residual(int, sunrealtype t, N_Vector y, N_Vector y_dot, N_Vector, N_Vector* s,
                                  N_Vector* s_dot, N_Vector* out, void* user, N_Vector, N_Vector, N_Vector) {
    return self(user).sensitivities_->residual(t, y, y_dot, s, s_dot, out);
  }

  std::size_t own_bytes() const override { return sensitivities_ ? sensitivities_->bytes() : 0; }

  int max_order_;
  int corrector_;
  Vector momentum_;
  OwnedVector y_dot_;
  std::optional<ForwardSensitivities> sensitivities_;
  std::unique_ptr<void, FreeIda> memory_;
};

class IdaBdfChoice : public SettableChoice<IdaBdfChoice>, public Options, public SensitivityOptions {
 public:
  static const Spec<IdaBdfChoice>& spec() {
    static const auto s = bdf_spec<IdaBdfChoice>();
    return s;
  }
  static MethodFacts facts() {
    return method_facts("1-5, variable", "as cvode_bdf, with a fixed leading coefficient",
                        "linear invariants (momentum); energy of oscillations is damped",
                        "Hindmarsh et al., ACM TOMS 31, 2005; Brenan, Campbell & Petzold 1996");
  }
  bool runs_on_ranks() const override { return true; }
  bool computes_sensitivities() const override { return true; }
  InternalSupport internal_support() const override { return InternalSupport::own; }
  bool solves_constraints() const override { return true; }
  std::unique_ptr<Integrator> make_for(const Model& model, const Task& task) const override {
    const Scales sizes = scales(task);
    return std::make_unique<IdaBdf>(model, *this, sizes, bdf_order(max_order, model, task, rtol, sizes),
                                    task.sensitivities, is_simultaneous());
  }

  std::optional<int> max_order;
};

const bool ida_bdf_registered = Registry<IntegratorChoice>::add<IdaBdfChoice>(
    "ida_bdf", "IDA: backward differentiation formulas of order 1-5 on the implicit system, adaptive.");

}  // namespace
}  // namespace orthodyn::sundials
