// Semi-implicit Euler (Baraff & Witkin 1998) for y' = f(y): backward Euler with f linearised at the start of the step,
// (I - h J) u = h f(y0), y1 = y0 + u. It costs one linear solve per step.
#include "integrators/native/linearly_implicit.h"

namespace orthodyn {
namespace {

class SemiImplicitEuler : public LinearlyImplicit {
 public:
  SemiImplicitEuler(const Model& model, const LinearOptions& options, const Scales& scales)
      : LinearlyImplicit("semi_implicit_euler", model, options, scales, 1),
        dq_(model.num_dofs()),
        dv_(model.num_dofs()) {}

 protected:
  Orders orders() const override { return {1, 2}; }

  bool attempt(double h) override {
    if (!prepare(h)) return false;
    dq_ = h * now().v;
    dv_ = h * force_now();
    solve_.solve(dq_, dv_, dq_, dv_);
    next_.q = now().q + dq_;
    next_.v = now().v + dv_;
    finish(dv_ / h);
    return true;
  }

  // The error estimate is (I - h J)^-1 h (f(y1) - f(y0)) / 2: half the change of the slope times h, damped like the
  // solution. It costs one more solve.
  void estimate(double h, VectorRef e_q, VectorRef e_v) override {
    dq_ = 0.5 * h * dv_;
    dv_ = 0.5 * h * (force_next() - force_now());
    solve_.solve(dq_, dv_, e_q, e_v);
  }

 private:
  Vector dq_, dv_;
};

class SemiImplicitEulerChoice : public SettableChoice<SemiImplicitEulerChoice>, public LinearOptions {
 public:
  static const Spec<SemiImplicitEulerChoice>& spec() {
    static const auto s = LinearOptions::spec_for<SemiImplicitEulerChoice>();
    return s;
  }
  static MethodFacts facts() {
    return method_facts("1", "L-stable for linear models; damps every oscillation", "momentum",
                        "Baraff & Witkin 1998; error estimate: difference to the trapezoidal rule");
  }
  bool runs_on_ranks() const override { return true; }
  InternalSupport internal_support() const override { return InternalSupport::fixed_steps; }
  std::unique_ptr<Integrator> make_for(const Model& model, const Task& task) const override {
    return std::make_unique<SemiImplicitEuler>(model, *this, scales(task));
  }
};

const bool semi_implicit_euler_registered = Registry<IntegratorChoice>::add<SemiImplicitEulerChoice>(
    "semi_implicit_euler", "Backward Euler with one linear solve per step, as in computer graphics.");

}  // namespace
}  // namespace orthodyn
