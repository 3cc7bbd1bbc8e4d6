// Semi-implicit Euler, the step of Baraff & Witkin (1998): backward Euler with the force linearised at the beginning,
// (I - h J) u = h f(y0), y1 = y0 + u. One linear solve a step.
#include "integrators/native/linearly_implicit.h"

namespace orthodyn {
namespace {

class SemiImplicitEuler : public LinearlyImplicit {
 public:
  SemiImplicitEuler(const Model& model, const LinearOptions& options, const Scales& scales)
      : LinearlyImplicit("semi_implicit_euler", model, options, scales, 1), dq_(model.num_dofs()),
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

  // Half the change of the slope over the step, u - h f(y0) = h J u, damped like the solution:
  // (I - h J)^-1 h J u = (I - h J)^-1 u - u. One more solve.
  void estimate(double, VectorRef e_q, VectorRef e_v) override {
    model_.multiply_mass(dv_, e_v);
    solve_.solve(dq_, e_v, e_q, e_v);
    e_q = 0.5 * (e_q - dq_);
    e_v = 0.5 * (e_v - dv_);
  }

 private:
  Vector dq_, dv_;
};

class SemiImplicitEulerChoice : public IntegratorChoice, public LinearOptions {
 public:
  static const Spec<SemiImplicitEulerChoice>& spec() {
    static const auto s = LinearOptions::spec_for<SemiImplicitEulerChoice>();
    return s;
  }
  static MethodFacts facts() {
    return method_facts("1", "L-stable for linear models; damps every oscillation", "momentum",
                        "Baraff & Witkin 1998; error estimate: difference to the trapezoidal rule, linearised");
  }
  std::unique_ptr<Integrator> make(const Model& model, const Task& task) const override {
    return std::make_unique<SemiImplicitEuler>(model, *this, scales(task));
  }
};

const bool registered = Registry<IntegratorChoice>::add<SemiImplicitEulerChoice>(
    "semi_implicit_euler", "Backward Euler with one linear solve a step, as in computer graphics.");

}  // namespace
}  // namespace orthodyn
