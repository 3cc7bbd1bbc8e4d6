// Work of loads and damping along a known motion whose velocities are inaccurate, as those of stiff methods are.
#include <gtest/gtest.h>

#include "lib/simulation/output/balance.h"
#include "tests/scene/scenes.h"

namespace orthodyn::work_along_positions_test {
namespace {

// Displacements p(t) times a direction, with velocities p'(t) times it and noise.
class Told : public Integrator {
 public:
  Told(Vector direction, Vector noise) : direction_(std::move(direction)), noise_(std::move(noise)) {}
  void start(const State&) override {}
  StepInfo step(double t_stop) override { return {t_stop, t_stop, 1}; }
  void interpolate(double t, State& out) const override {
    out.t = t;
    out.q = (t * t * t - t) * direction_;
    out.v = (3 * t * t - 1) * direction_ + (t < 0.5 ? 1 : -1) * noise_;
  }
  const Statistics& statistics() const override { return statistics_; }

 private:
  Vector direction_, noise_;
  Statistics statistics_;
};

// The same in steps from 0 to 1 and from 1 to 1.5, whose mean states it tells.
class ToldByMeans : public Told {
 public:
  using Told::Told;
  void take_second_step() { begin_ = 1, end_ = 1.5; }
  std::optional<State> mean_state() const override {
    State first, last;
    interpolate(begin_, first);
    interpolate(end_, last);
    return State{(begin_ + end_) / 2, (first.q + last.q) / 2, (last.q - first.q) / (end_ - begin_)};
  }

 private:
  double begin_ = 0, end_ = 1;
};

BuiltScene bar() {
  return build_text(
      "mesh: {type: box, size: [2, 1, 1], cells: [2, 1, 1], order: 1}\n"
      "materials: {soft: {type: isotropic, density: 1000, young: 1e6, nu: 0.3}}\n"
      "clamps: [{surface: x0}]\nloads: [{surface: x1, force: [3, 0, 1]}]\n"
      "elasticity: {kinematics: linear}\ndamping: {stiffness: 1e-3}\ntime: {end: 1}\n");
}

EnergyBalance told(const FemModel& model, const Vector& direction, const Vector& noise) {
  const Told integrator(direction, noise);
  EnergyMeter meter(model, integrator);
  State state;
  for (const double t : {0.0, 0.4, 1.0}) {
    integrator.interpolate(t, state);
    const ObservedState observed(model, state);
    t == 0 ? meter.on_start(observed) : meter.on_step({t, 0, 1}, observed, integrator);
  }
  return meter.last();
}

Vector arbitrary(int n, double size) {
  Vector x(n);
  for (int i = 0; i < n; ++i) x[i] = size * std::sin(1.0 + 7 * i);
  return x;
}

// int_0^1 (3 t^2 - 1)^2 dt = 4/5 times the power at unit speed. The error of two-point Gauss quadrature is h^5/4320
// times the fourth derivative, 216, per step: 0.4 % here.
TEST(WorkAlongPositions, IsTheSameWhateverTheVelocitiesAre) {
  const BuiltScene built = bar();
  const FemModel& model = *built.model;
  const Vector direction = arbitrary(model.num_dofs(), 1e-3), none = Vector::Zero(model.num_dofs());
  const Vector noise = arbitrary(model.num_dofs(), 2e-3).reverse();
  const EnergyBalance clean = told(model, direction, none), noisy = told(model, direction, noise);
  EXPECT_NEAR(noisy.dissipated, clean.dissipated, 1e-9 * clean.dissipated);
  EXPECT_NEAR(noisy.loads, clean.loads, 1e-9 * std::abs(clean.loads) + 1e-12);
  const State moving{0, none, direction};
  const double power = ObservedState(model, moving).evaluate("power.dissipated")[0];
  EXPECT_NEAR(clean.dissipated, 0.8 * power, 0.01 * power);
}

TEST(WorkAlongPositions, OfAConstantForceIsForceTimesWay) {
  const BuiltScene built = bar();
  const FemModel& model = *built.model;
  const Vector direction = arbitrary(model.num_dofs(), 1e-3), noise = arbitrary(model.num_dofs(), 2e-3).reverse();
  const Vector still = Vector::Zero(model.num_dofs());
  Vector load(model.num_dofs());
  model.force(0, still, still, load);
  const Told integrator(direction, noise);
  EnergyMeter meter(model, integrator);
  State state;
  integrator.interpolate(0, state);
  meter.on_start(ObservedState(model, state));
  for (const double t : {0.3, 0.6, 1.0}) {
    integrator.interpolate(t, state);
    meter.on_step({t, 0, 1}, ObservedState(model, state), integrator);
    EXPECT_NEAR(meter.last().loads, (t * t * t - t) * load.dot(direction), 1e-9 * std::abs(load.dot(direction))) << t;
  }
}

// Outputs lie within the steps.
TEST(WorkAtMeanStates, OfAConstantForceIsForceTimesWay) {
  const BuiltScene built = bar();
  const FemModel& model = *built.model;
  const Vector direction = arbitrary(model.num_dofs(), 1e-3), noise = arbitrary(model.num_dofs(), 2e-3).reverse();
  const Vector still = Vector::Zero(model.num_dofs());
  Vector load(model.num_dofs());
  model.force(0, still, still, load);
  ToldByMeans integrator(direction, noise);
  EnergyMeter meter(model, integrator, EnergyTimes::outputs);
  const auto observe = [&](double t, auto&& call) {
    State state;
    integrator.interpolate(t, state);
    call(ObservedState(model, state));
  };
  const auto output = [&](double t) {
    observe(t, [&](const ObservedState& at) { meter.on_output(at); });
    EXPECT_NEAR(meter.last().loads, (t * t * t - t) * load.dot(direction), 1e-9 * std::abs(load.dot(direction))) << t;
  };
  const auto end_step = [&](double t) {
    observe(t, [&](const ObservedState& at) { meter.on_step({t, 0, 1}, at, integrator); });
  };
  observe(0, [&](const ObservedState& at) { meter.on_start(at); });
  output(0.3);
  output(0.7);
  end_step(1);
  integrator.take_second_step();
  output(1.2);
  output(1.5);
  end_step(1.5);
}

}  // namespace
}  // namespace orthodyn::work_along_positions_test
