// Example of a user's integrator: velocity Verlet (leapfrog), which is explicit, of second order, with a fixed step.
#include "lib/core/errors.h"
#include "lib/ode/hermite.h"
#include "lib/ode/settable_choice.h"

namespace {

using namespace orthodyn;

class VelocityVerlet : public Integrator {
 public:
  VelocityVerlet(const Model& model, double step) : model_(model), step_(step) {}

  void start(const State& state) override {
    end_ = {state.t, state.q, state.v, acceleration(state.t, state.q, state.v)};
    begin_ = end_;
  }

  StepInfo step(double t_stop) override {
    const double left = t_stop - end_.t;
    const bool last = left < step_ * (1 + 1e-9);  // avoids a tiny step at the end
    const double h = last ? left : step_;
    begin_ = end_;
    end_.t = last ? t_stop : begin_.t + h;
    end_.q = begin_.q + h * begin_.v + 0.5 * h * h * begin_.a;
    end_.a = acceleration(end_.t, end_.q, begin_.v);
    end_.v = begin_.v + 0.5 * h * (begin_.a + end_.a);
    if (!end_.q.allFinite())
      throw RunError("velocity_verlet is unstable at t = " + std::to_string(end_.t) + " s; lower integrator.step",
                     Reason::newton);
    ++statistics_.steps;
    return {end_.t, h, 2};
  }

  void interpolate(double t, State& out) const override {
    out = {t, Vector(end_.q.size()), Vector(end_.q.size())};
    orthodyn::interpolate(begin_, end_, t, out.q, out.v);
  }

  const Statistics& statistics() const override { return statistics_; }

 private:
  Vector acceleration(double t, const Vector& q, const Vector& v) {
    const Measure measure(statistics_.force);
    Vector a(q.size());
    model_.force(t, q, v, a);
    model_.solve_mass(a);
    return a;
  }

  const Model& model_;
  double step_;
  StepEnd begin_, end_;
  Statistics statistics_;
};

class VelocityVerletChoice : public SettableChoice<VelocityVerletChoice> {
 public:
  static const Spec<VelocityVerletChoice>& spec() {
    static const auto s = Spec<VelocityVerletChoice>().key("step", &VelocityVerletChoice::step, "Step.",
                                                           {.required = true, .unit = "s", .range = kPositive});
    return s;
  }

  std::unique_ptr<Integrator> make_for(const Model& model, const Task&) const override {
    if (model.traits().dissipative)
      throw ConfigError("velocity_verlet does not support forces that depend on velocity; remove the damping");
    return std::make_unique<VelocityVerlet>(model, step);
  }

  double step = 0;  // s
};

const bool velocity_verlet_registered = Registry<IntegratorChoice>::add<VelocityVerletChoice>(
    "velocity_verlet", "Leapfrog in velocity form: explicit, order 2, symplectic, fixed step.");

}  // namespace
