// The energy-momentum method (Simo & Tarnow 1992; Gonzalez 2000). With the mean force f(q0, q1) of a discrete gradient
// (lib/ode/model.h), a step h satisfies
//
//     q1 - q0 = h (v0 + v1) / 2,    M (v1 - v0) = h f(q0, q1).
//
// The method conserves energy and, without external loads, linear and angular momentum. Velocity-dependent forces are
// evaluated at the midpoint.
//
// Conservation is as accurate as the iteration, which therefore continues to round-off. It is Newton's method with
// Anderson acceleration (anderson.h). Its matrix is that of the midpoint rule at a predicted midpoint, which is
// symmetric, unlike df/dq1. An inverted element has no discrete gradient: the step is shortened, and finally the run
// fails.
#include <algorithm>
#include <cmath>

#include "integrators/native/anderson.h"
#include "integrators/native/one_step.h"
#include "integrators/newton_matrix.h"
#include "integrators/run_checks.h"

namespace orthodyn {
namespace {

// Convergence tests. Relative to the first correction: limit for converged; limit for converged if corrections no
// longer shrink (round-off).
constexpr double kConverged = 1e-15, kResidualRoundOff = 1e-11;
// Relative to the scales: limit for converged if corrections have not shrunk for kStalled iterations.
constexpr double kNegligible = 1e-9;
constexpr int kStalled = 5;
constexpr double kDiverged = 100;  // relative to the smallest correction so far
constexpr int kAndersonDepth = 5;

struct EnergyMomentumOptions : LinearOptions {
  int max_newton_iterations = 50;
};

const DiscreteGradient& gradient_of(const Model& model) {
  const DiscreteGradient* gradient = model.discrete_gradient();
  if (!gradient)
    throw ConfigError(
        "energy_momentum needs a force that is the gradient of an energy. The warped force is not (use "
        "elasticity.corotation: exact), nor is the force of moved nodes with a consistent mass (use mass: lumped). "
        "Contact of bodies and forces of joints have no mean force between two states. Or choose another integrator");
  return *gradient;
}

class EnergyMomentum : public OneStep {
 public:
  EnergyMomentum(const Model& model, const EnergyMomentumOptions& options, const Scales& scales)
      : OneStep("energy_momentum", model, options, scales),
        max_iterations_(options.max_newton_iterations),
        gradient_(gradient_of(model)),
        matrix_(model, options.linear_solver, options.tangent(), statistics_),
        anderson_(model.num_dofs(), kAndersonDepth),
        x_(model.num_dofs()),
        q_(model.num_dofs()),
        v_(model.num_dofs()),
        r_(model.num_dofs()),
        mx_(model.num_dofs()) {}
  std::size_t factor_bytes() const override { return matrix_.factor_bytes(); }

 protected:
  Orders orders() const override { return {2, 3}; }
  bool balances_by_mean_velocity() const override { return true; }
  void restarted() override { last_h_ = 0; }

  bool attempt(double h) override {
    // The guess is zero, because the last acceleration predicts nothing if steps are much longer than the fast periods.
    x_.setZero();
    if (!prepare(h) || !iterate(h)) return false;
    next_.v = now().v + h * x_;
    next_.q = now().q + 0.5 * h * (now().v + next_.v);
    force(next_.t, next_.q, next_.v, next_.a);
    model_.solve_mass(next_.a);
    return true;
  }

  // Estimates the error of the trapezoidal rule, to which the method reduces for linear models, from differences of
  // accelerations (Zienkiewicz & Xie 1991). The error in v also contains the difference from the trapezoidal rule.
  void estimate(double h, VectorRef e_q, VectorRef e_v) override {
    const auto change = next_.a - now().a;
    e_v = change;
    if (last_h_ > 0) e_v = 2 * h / (h + last_h_) * (change - h / last_h_ * last_change_);
    e_v = h / 12 * e_v + h * (0.5 * (now().a + next_.a) - x_);
    e_q = h * h / 12 * change;
    filter(h, e_q, e_v);
  }

  void accepted(double h) override {
    last_change_ = next_.a - now().a;
    last_h_ = h;
  }

  std::string solver_description() const override { return matrix_.description(); }
  std::size_t method_bytes() const override {
    return matrix_.bytes() + (9 + 2 * kAndersonDepth) * static_cast<std::size_t>(x_.size()) * sizeof(double);
  }

 private:
  // Multiplies by (I - h/2 J)^-1, which removes the stiff, meaningless part of the estimate (Shampine 1984).
  void filter(double h, VectorRef e_q, VectorRef e_v) {
    matrix_.multiply_stiffness(e_q, mx_);
    model_.multiply_mass(e_v, r_);
    r_ -= 0.5 * h * mx_;
    matrix_.solve(r_, r_);
    e_v = r_;
    e_q += 0.5 * h * r_;
  }

  // Sets the midpoint velocity v_ and position q_ from the mean acceleration x_.
  void set_midpoint(double h) {
    v_ = now().v + 0.5 * h * x_;
    q_ = now().q + 0.5 * h * v_;
  }

  bool prepare(double h) {
    if (model_.traits().linear && h == factored_for_) return true;
    set_midpoint(h);
    matrix_.linearize(now().t + 0.5 * h, q_, v_);
    factored_for_ = matrix_.factor({1, 0.5 * h, 0.25 * h * h}) ? h : 0;
    return factored_for_ == h;
  }

  bool iterate(double h) {
    anderson_.restart();
    double first = 0, smallest = 0;
    int stalled = 0;
    for (int k = 0; k < max_iterations_; ++k) {
      correction(h);
      const double size = norm_(r_, 0.25 * h * h, 0.5 * h);
      if (!std::isfinite(size)) return false;
      anderson_.accelerate(x_, r_);
      x_ += r_;
      if (k == 0) first = smallest = size;
      if (size <= kConverged * first) return true;
      if (k > 0 && size >= smallest) {
        if (size <= kResidualRoundOff * first) return true;
        if (size > kDiverged * smallest) return false;
        if (++stalled >= kStalled && size * norm_.rtol() <= kNegligible) return true;
      } else {
        stalled = 0;
      }
      smallest = std::min(smallest, size);
    }
    return smallest <= kResidualRoundOff * first;
  }

  // r <- A^-1 (f - M x)
  void correction(double h) {
    set_midpoint(h);
    {
      const Measure measure(statistics_.force);
      const StepEnd& from = now();
      gradient_.mean_force(from.t, from.q, from.t + h, from.q + h * v_, v_, r_);
    }
    require_finite(model_, r_);
    model_.multiply_mass(x_, mx_);
    r_ -= mx_;
    matrix_.solve(r_, r_);
    ++statistics_.newton_iterations;
  }

  int max_iterations_;
  const DiscreteGradient& gradient_;
  NewtonMatrix matrix_;
  double factored_for_ = 0;  // step h of the factor, s; 0 without a factor
  Anderson anderson_;
  Vector x_, q_, v_, r_, mx_;
  double last_h_ = 0;   // 0 after a restart
  Vector last_change_;  // change of the acceleration over the last step
};

class EnergyMomentumChoice : public SettableChoice<EnergyMomentumChoice>, public EnergyMomentumOptions {
 public:
  static const Spec<EnergyMomentumChoice>& spec() {
    static const auto s = LinearOptions::spec_for<EnergyMomentumChoice>().key(
        "max_newton_iterations", &EnergyMomentumChoice::max_newton_iterations,
        "Iterations per step; they converge to round-off.", {.range = {1, 1000}});
    return s;
  }
  static MethodFacts facts() {
    return method_facts(
        "2", "A-stable for linear models; no numerical damping", "energy, linear and angular momentum, to round-off",
        "Simo & Tarnow, ZAMP 43, 1992; Gonzalez, CMAME 190, 2000; error estimate: difference to the trapezoidal rule");
  }
  std::unique_ptr<Integrator> make_for(const Model& model, const Task& task) const override {
    return std::make_unique<EnergyMomentum>(model, *this, scales(task));
  }
};

const bool energy_momentum_registered = Registry<IntegratorChoice>::add<EnergyMomentumChoice>(
    "energy_momentum", "Conserves energy and momentum at any step; adaptive or with a fixed step, implicit.");

}  // namespace
}  // namespace orthodyn
