// The exponential Rosenbrock method EXPRB32 on y' = F(t, y), y = (q, v), F = (v, M^-1 f), of order 3:
//
//   U  = y + h phi_1(h J) F,                                (order 2: exponential Rosenbrock-Euler)
//   y1 = U + 2 h phi_3(h J) (F(U) - F - J (U - y)),         J = dF/dy at y,
//
// The last term of y1 is the error estimate of U. The method is exact for linear systems of any stiffness, up to the
// error of the Krylov spaces in which the phi_k are evaluated (krylov_phi.h). Krylov spaces need no factorisation, but
// their dimension grows with h times the highest frequency. If the force depends on time, time is an additional
// unknown, and J contains dF/dt as a difference quotient. Source: Hochbruck, Ostermann & Schweitzer, SIAM J. Numer.
// Anal. 47, 2009.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "integrators/critical_step.h"
#include "integrators/error_control.h"
#include "integrators/fixed_step.h"
#include "integrators/native/explicit_step.h"
#include "integrators/native/krylov_phi.h"
#include "integrators/native/scaled_system.h"
#include "integrators/native/step_controllers.h"
#include "integrators/native/time_difference.h"

namespace orthodyn {
namespace {

// Tolerance of each Krylov space as a share of the tolerance of a step. It is small because errors in stiff modes
// accumulate in a rotating body.
constexpr double kKrylovShare = 1e-4;

struct ExponentialOptions : ErrorControl, FixedStep {
  int krylov_dimension = 40;
};

class ExponentialRosenbrock : public ExplicitStep {
 public:
  ExponentialRosenbrock(const Model& model, const Task& task, const ExponentialOptions& options)
      : ExplicitStep(model, remedies(options), 3, options.max_steps),
        options_(options),
        scales_(options.scales(task)),
        adaptive_(3),
        system_(model, options.rtol, scales_),
        slope_(model.num_dofs()),
        stage_(system_.size()),
        correction_(system_.size()),
        rate_space_(system_.size(), options.krylov_dimension),
        defect_space_(system_.size(), options.krylov_dimension) {}

  std::size_t bytes() const override {
    const auto n = static_cast<std::size_t>(model_.num_dofs());
    return system_.bytes() + rate_space_.bytes() + defect_space_.bytes() + 18 * n * sizeof(double);
  }

  Decisions decisions() const override { return scale_decisions(scales_); }

  bool adaptive() const override { return !options_.step; }
  bool has_accurate_interpolation() const override { return false; }
  std::optional<State> mean_state() const override { return mean_of_step(); }

 private:
  static Remedies remedies(const ExponentialOptions& options) {
    if (options.step) return {"exponential_rosenbrock", "lower integrator.step", "integrator.step"};
    return {"exponential_rosenbrock", "lower integrator.h_max", "integrator.rtol"};
  }

  void begin(StepEnd&) override { adaptive_.restart(); }

  void advance(double t_stop) override {
    linearize(t_stop);
    if (options_.step) take_fixed(length_of_fixed_step(*options_.step, t_stop - end().t), t_stop);
    else take_controlled(t_stop);
  }

  // Computes F and J at the start of the step, and starts the Krylov space of F.
  void linearize(double t_stop) {
    const StepEnd& from = end();
    {
      const Measure measure(statistics_.tangent);
      system_.linearize({from.t, from.q, from.v});
    }
    if (system_.with_time()) {
      const double later = shortly_after(from.t, options_.step              ? *options_.step
                                                 : adaptive_.proposed() > 0 ? adaptive_.proposed()
                                                                            : t_stop - from.t);
      acceleration(later, from.q, from.v, slope_);
      slope_ = (slope_ - from.a) / (later - from.t);
      system_.set_slope(slope_);
    }
    system_.rate(from.v, from.a, rate_);
    rate_space_.begin(jacobian(), rate_);
  }

  KrylovPhi::Operator jacobian() {
    return [this](const Eigen::Ref<const Vector>& x, VectorRef y) { system_.multiply(x, y); };
  }

  void take_fixed(double h, double t_stop) {
    if (!try_step(h, t_stop))
      fail(fmt::format("a Krylov space of dimension {} is too small for this step; raise integrator.krylov_dimension "
                       "or lower integrator.step",
                       options_.krylov_dimension),
           Reason::other);
  }

  void take_controlled(double t_stop) {
    const double rest = t_stop - end().t;
    if (adaptive_.proposed() == 0) adaptive_.propose(first_step(rest));
    adaptive_.take(
        statistics_, [&] { return allowed(rest); }, [&](double h) { return try_step(h, t_stop); },
        [&](bool has_error) { refuse_tiny_steps(has_error); });
  }

  double allowed(double rest) const {
    return length_of_step(
        std::min(adaptive_.proposed(), options_.h_max.value_or(std::numeric_limits<double>::infinity())), rest);
  }

  void refuse_tiny_steps(bool by_error) const {
    if (!adaptive_.is_too_short(options_.h_min, end().t)) return;
    if (by_error)
      fail(
          "the error test keeps failing; raise integrator.rtol, lower integrator.h_min, or look for a kink in the "
          "loads",
          Reason::error_test);
    if (adaptive_.cause().empty())
      fail(fmt::format("a Krylov space of dimension {} does not converge at the smallest step; raise "
                       "integrator.krylov_dimension or lower integrator.h_min",
                       options_.krylov_dimension),
           Reason::other);
    fail(adaptive_.cause().explain("the force cannot be evaluated", "; lower integrator.h_max or check the loads"),
         Reason::force);
  }

  // Attempts a step h (s). Returns its error in units of the tolerance, or nothing if a Krylov space is too small.
  std::optional<double> try_step(double h, double t_stop) {
    const StepEnd& from = end();
    next_.t = h == t_stop - from.t ? t_stop : from.t + h;
    next_.q = from.q;
    next_.v = from.v;
    if (!apply(rate_space_, 1, h, stage_)) return std::nullopt;
    stage_ *= h;
    system_.move(stage_, next_.q, next_.v);
    acceleration(next_.t, next_.q, next_.v, next_.a);
    begin_defect();
    if (!apply(defect_space_, 3, h, correction_)) return std::nullopt;
    correction_ *= 2 * h;
    system_.move(correction_, next_.q, next_.v);
    acceleration(next_.t, next_.q, next_.v, next_.a);
    const double error = system_.rms(correction_);
    if (!std::isfinite(error)) throw RecoverableError("the step is not finite");
    return error;
  }

  // Starts the Krylov space of F(U) - F - J (U - y). Only the velocity part of this defect is nonzero. Since q' = v and
  // t' = 1 are linear, the rest is round-off and set to zero.
  void begin_defect() {
    system_.multiply(stage_, correction_);
    system_.rate(next_.v, next_.a, defect_);
    defect_ -= rate_ + correction_;
    defect_.head(model_.num_dofs()).setZero();
    if (system_.with_time()) defect_.tail(1).setZero();
    defect_space_.begin(jacobian(), defect_);
  }

  // An error e in phi_k causes an error h e in the solution: hence the tolerance.
  bool apply(KrylovPhi& space, int k, double h, Vector& out) {
    const Measure measure(statistics_.solve);
    return space.apply(k, h, kKrylovShare / h, out);
  }

  // The step (s) at which the error h^2/2 J F of Euler's method is at the tolerance.
  double first_step(double rest) {
    if (options_.h0) return *options_.h0;
    system_.multiply(rate_, stage_);
    const double curvature = system_.rms(stage_);
    return curvature > 0 ? std::min(rest, std::sqrt(2 / curvature)) : rest;
  }

  ExponentialOptions options_;
  Scales scales_;
  AdaptiveStep adaptive_;
  ScaledSystem system_;
  Vector slope_, rate_;                 // d(M^-1 f)/dt and F at the start of the step
  Vector stage_, correction_, defect_;  // U - y; y1 - U; F(U) - F - J (U - y)
  KrylovPhi rate_space_, defect_space_;
};

class ExponentialRosenbrockChoice : public SettableChoice<ExponentialRosenbrockChoice>, public ExponentialOptions {
 public:
  static const Spec<ExponentialRosenbrockChoice>& spec() {
    using C = ExponentialRosenbrockChoice;
    static const auto s = FixedStep::add_to(
        ErrorControl::spec_for<C>().key("krylov_dimension", &C::krylov_dimension,
                                        "Largest dimension of a Krylov space; a step that needs more is shortened.",
                                        {.range = {4, 500}}),
        "Fixed step instead of error control; rtol then applies only to the Krylov spaces.");
    return s;
  }
  static MethodFacts facts() {
    return method_facts("3",
                        "A-stable, exact for linear systems; the Krylov space grows with step times highest frequency",
                        "linear invariants (momentum), to tolerance",
                        "Hochbruck, Ostermann & Schweitzer, SIAM J. Numer. Anal. 47, 2009; Niesen & Wright 2012");
  }
  std::unique_ptr<Integrator> make_for(const Model& model, const Task& task) const override {
    if (!step) refuse_too_many_steps("exponential_rosenbrock", model, task, krylov_reach(model), max_steps);
    return std::make_unique<ExponentialRosenbrock>(model, task, *this);
  }

 private:
  // Largest step in units of the leapfrog's critical step (2/omega undamped, 1/delta damped). A space of dimension m
  // reaches h omega of about m undamped, and h delta of m^2/4 if damping makes the spectrum real (Hochbruck & Lubich
  // 1997).
  double krylov_reach(const Model& model) const {
    const double m = krylov_dimension;
    return model.traits().damping_matrix ? std::max(m / 2, m * m / 4) : m / 2;
  }
};

const bool exponential_rosenbrock_registered = Registry<IntegratorChoice>::add<ExponentialRosenbrockChoice>(
    "exponential_rosenbrock", "Exponential Rosenbrock method of order 3 (EXPRB32) in Krylov spaces: no factorisation.");

}  // namespace
}  // namespace orthodyn
