// The exponential Rosenbrock method EXPRB32 on y' = F(t, y), y = (q, v), F = (v, M^-1 f), of order 3:
//
//   U  = y + h phi_1(h J) F,                                (order 2: exponential Rosenbrock-Euler)
//   y1 = U + 2 h phi_3(h J) (F(U) - F - J (U - y)),         J = dF/dy at y,
//
// whose last part is the error of U that is controlled. Exact for linear systems, whatever their stiffness,
// up to the Krylov spaces in which the functions are applied: these need no factor, but a dimension that grows
// with h times the highest frequency. Time is an unknown where the force depends on it: J then holds dF/dt, a
// difference quotient (Hochbruck, Ostermann & Schweitzer, SIAM J. Numer. Anal. 47, 2009).
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
#include "integrators/native/step_control.h"
#include "integrators/native/time_difference.h"

namespace orthodyn {
namespace {

// Of the tolerance, for each Krylov space: its errors in stiff modes add up where a body turns.
constexpr double kKrylovShare = 1e-4;
constexpr double kRetryFactor = 0.25;

struct ExponentialOptions : ErrorControl, FixedStep {
  int krylov_dimension = 40;
};

class ExponentialRosenbrock : public ExplicitStep {
 public:
  ExponentialRosenbrock(const Model& model, const Task& task, const ExponentialOptions& options)
      : ExplicitStep(model, words(options), 3, options.max_steps),
        options_(options),
        scales_(options.scales(task)),
        control_(3),
        system_(model, options.rtol, scales_),
        slope_(model.num_dofs()),
        stage_(system_.size()),
        correction_(system_.size()),
        from_rate_(system_.size(), options.krylov_dimension),
        from_defect_(system_.size(), options.krylov_dimension) {}

  std::size_t bytes() const override {
    const auto n = static_cast<std::size_t>(model_.num_dofs());
    return system_.bytes() + from_rate_.bytes() + from_defect_.bytes() + 18 * n * sizeof(double);
  }

  Decisions decisions() const override { return scale_decisions(scales_); }

  bool adaptive() const override { return !options_.step; }
  bool has_accurate_interpolation() const override { return false; }
  std::optional<State> mean_state() const override { return mean_of_step(); }

 private:
  static Words words(const ExponentialOptions& options) {
    if (options.step) return {"exponential_rosenbrock", "lower integrator.step", "integrator.step"};
    return {"exponential_rosenbrock", "lower integrator.h_max", "integrator.rtol"};
  }

  void begin() override {
    h_ = 0;
    control_.restart();
  }

  void advance(double t_stop) override {
    linearize(t_stop);
    if (options_.step) take_fixed(length_of_fixed_step(*options_.step, t_stop - end().t), t_stop);
    else take_controlled(t_stop);
  }

  // F and J at the beginning of the step, and the Krylov space of F.
  void linearize(double t_stop) {
    const StepEnd& from = end();
    {
      const Measure measure(statistics_.tangent);
      system_.linearize({from.t, from.q, from.v});
    }
    if (system_.with_time()) {
      const double later = shortly_after(from.t, options_.step ? *options_.step : h_ > 0 ? h_ : t_stop - from.t);
      acceleration(later, from.q, from.v, slope_);
      slope_ = (slope_ - from.a) / (later - from.t);
      system_.set_slope(slope_);
    }
    system_.rate(from.v, from.a, rate_);
    from_rate_.begin(jacobian(), rate_);
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
    if (h_ == 0) h_ = first_step(rest);
    bool refused = false;
    for (;;) {
      const double h = allowed(rest);
      const std::optional<double> error = try_recoverably(h, t_stop);
      if (error && *error <= 1) {
        const double factor = control_.after_success(*error);
        const double proposed = h * (refused ? std::min(factor, 1.0) : factor);
        h_ = h < h_ ? std::max(h_, proposed) : proposed;  // a stop cut the step short
        return;
      }
      refused = true;
      ++statistics_.rejected_steps;
      ++(error ? statistics_.error_test_failures : statistics_.convergence_failures);
      h_ = h * (error ? control_.after_failure(*error) : kRetryFactor);
      refuse_tiny_steps(error.has_value());
    }
  }

  double allowed(double rest) const {
    return length_of_step(std::min(h_, options_.h_max.value_or(std::numeric_limits<double>::infinity())), rest);
  }

  void refuse_tiny_steps(bool by_error) const {
    const double resolution = 4 * std::numeric_limits<double>::epsilon() * std::abs(end().t);
    if (h_ > std::max({options_.h_min, resolution, std::numeric_limits<double>::min()})) return;
    if (by_error)
      fail(
          "the error test keeps failing; raise integrator.rtol, lower integrator.h_min, or look for a kink in the "
          "loads",
          Reason::error_test);
    if (cause_.empty())
      fail(fmt::format("a Krylov space of dimension {} does not converge at the smallest step; raise "
                       "integrator.krylov_dimension or lower integrator.h_min",
                       options_.krylov_dimension),
           Reason::other);
    fail("the force cannot be evaluated (" + cause_ + "); lower integrator.h_max or check the loads", Reason::force);
  }

  std::optional<double> try_recoverably(double h, double t_stop) {
    cause_.clear();
    try {
      return try_step(h, t_stop);
    } catch (const RecoverableError& e) {
      cause_ = e.what();
      return std::nullopt;
    }
  }

  // The error in units of the tolerance; none if a Krylov space is too small.
  std::optional<double> try_step(double h, double t_stop) {
    const StepEnd& from = end();
    next_.t = h == t_stop - from.t ? t_stop : from.t + h;
    next_.q = from.q;
    next_.v = from.v;
    if (!apply(from_rate_, 1, h, stage_)) return std::nullopt;
    stage_ *= h;
    system_.move(stage_, next_.q, next_.v);
    acceleration(next_.t, next_.q, next_.v, next_.a);
    begin_defect();
    if (!apply(from_defect_, 3, h, correction_)) return std::nullopt;
    correction_ *= 2 * h;
    system_.move(correction_, next_.q, next_.v);
    acceleration(next_.t, next_.q, next_.v, next_.a);
    const double error = system_.rms(correction_);
    if (!std::isfinite(error)) throw RecoverableError("the step is not finite");
    return error;
  }

  // F(U) - F - J (U - y). Only forces have any: q' = v and t' = 1 are linear, and what is left there is round-off.
  void begin_defect() {
    system_.multiply(stage_, correction_);
    system_.rate(next_.v, next_.a, defect_);
    defect_ -= rate_ + correction_;
    defect_.head(model_.num_dofs()).setZero();
    if (system_.with_time()) defect_.tail(1).setZero();
    from_defect_.begin(jacobian(), defect_);
  }

  // An error of e in phi_k is one of h e in the solution.
  bool apply(KrylovPhi& space, int k, double h, Vector& out) {
    const Measure measure(statistics_.solve);
    return space.apply(k, h, kKrylovShare / h, out);
  }

  // At which Euler's method would be at tolerance: its error is h^2/2 J F.
  double first_step(double rest) {
    if (options_.h0) return *options_.h0;
    system_.multiply(rate_, stage_);
    const double curvature = system_.rms(stage_);
    return curvature > 0 ? std::min(rest, std::sqrt(2 / curvature)) : rest;
  }

  ExponentialOptions options_;
  Scales scales_;
  StepControl control_;
  double h_ = 0;       // proposed; 0 before the first step
  std::string cause_;  // why the model refused the last attempt, if it did
  ScaledSystem system_;
  Vector slope_, rate_;                 // dF/dt and F at the beginning
  Vector stage_, correction_, defect_;  // U - y, y1 - U
  KrylovPhi from_rate_, from_defect_;
};

class ExponentialRosenbrockChoice : public SettableChoice<ExponentialRosenbrockChoice>, public ExponentialOptions {
 public:
  static const Spec<ExponentialRosenbrockChoice>& spec() {
    using C = ExponentialRosenbrockChoice;
    static const auto s = [] {
      auto spec = ErrorControl::spec_for<C>().key(
          "krylov_dimension", &C::krylov_dimension,
          "Largest Krylov space; a step that would need a larger one is shortened.", {.range = {4, 500}});
      FixedStep::add_to(spec, "Fixed step, instead of error control; rtol then applies to the Krylov spaces only.");
      return spec;
    }();
    return s;
  }
  static MethodFacts facts() {
    return method_facts("3",
                        "A-stable, exact for linear systems; the Krylov space grows with step times highest "
                        "frequency",
                        "linear invariants (momentum), to tolerance",
                        "Hochbruck, Ostermann & Schweitzer, SIAM J. Numer. Anal. 47, 2009; Niesen & Wright 2012");
  }
  std::unique_ptr<Integrator> make(const Model& model, const Task& task) const override {
    if (!step) refuse_a_run_without_end("exponential_rosenbrock", model, task, krylov_reach(model), max_steps);
    return std::make_unique<ExponentialRosenbrock>(model, task, *this);
  }

 private:
  // In critical steps of the leapfrog, 2/omega, or 1/delta where it is damped: a space of dimension m reaches h omega
  // of about m undamped, and h delta of m^2/4 where damping makes the spectrum real (Hochbruck & Lubich 1997).
  double krylov_reach(const Model& model) const {
    const double m = krylov_dimension;
    return model.traits().damping_matrix ? std::max(m / 2, m * m / 4) : m / 2;
  }
};

const bool exponential_rosenbrock_registered = Registry<IntegratorChoice>::add<ExponentialRosenbrockChoice>(
    "exponential_rosenbrock", "Exponential Rosenbrock method of order 3 (EXPRB32) in Krylov spaces: no factorisation.");

}  // namespace
}  // namespace orthodyn
