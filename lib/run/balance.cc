#include "lib/run/balance.h"

#include <algorithm>
#include <cmath>

namespace orthodyn {

namespace {

// To the larger of the two; NaN stays.
void raise(double& largest, double value) {
  if (!(value <= largest) && !std::isnan(largest)) largest = value;
}

}  // namespace

void PowerIntegral::start(const State& state) {
  t_ = state.t;
  last_ = model_.evaluate(power_, state)[0];
}

double PowerIntegral::advance(const State& to, const Integrator& integrator) {
  if (!(to.t > t_)) return sum_;
  State middle;
  integrator.interpolate(0.5 * (t_ + to.t), middle);
  const double end = model_.evaluate(power_, to)[0];
  sum_ += (to.t - t_) / 6 * (last_ + 4 * model_.evaluate(power_, middle)[0] + end);
  t_ = to.t;
  last_ = end;
  return sum_;
}

EnergyMeter::EnergyMeter(const Model& model, const Integrator& integrator)
    : model_(model), integrator_(integrator), dissipation_(model, "power.dissipated"),
      load_work_(model, "power.loads") {}

void EnergyMeter::on_start(const State& state) {
  if (model_.traits().dissipative) dissipation_.start(state);
  if (model_.traits().loaded) load_work_.start(state);
  look(state);
  first_ = last_;
  drift_ = 0;
}

void EnergyMeter::look(const State& state) {
  if (model_.traits().dissipative) dissipation_.advance(state, integrator_);
  if (model_.traits().loaded) load_work_.advance(state, integrator_);
  const auto energy = [&](const char* name) { return model_.evaluate(name, state)[0]; };
  last_ = {energy("energy.kinetic"), energy("energy.elastic"), energy("energy.gravitational"),
           dissipation_.value(), load_work_.value()};
  raise(drift_, std::abs(change()));
  scale_ = std::max({scale_, last_.kinetic, last_.elastic});
}

void MomentumMeter::on_start(const State& state) {
  look(state);
  first_linear_ = linear_;
  first_angular_ = angular_;
  linear_drift_ = angular_drift_ = 0;
}

void MomentumMeter::look(const State& state) {
  const auto vector = [&](const char* name) {
    const auto values = model_.evaluate(name, state);
    return Vec3(values[0], values[1], values[2]);
  };
  linear_ = vector("momentum.linear");
  angular_ = vector("momentum.angular");
  raise(linear_drift_, (linear_ - first_linear_).norm());
  raise(angular_drift_, (angular_ - first_angular_).norm());
}

void InversionWatch::look(const State& state) {
  const auto now = model_.evaluate("det_f.smallest", state);
  if (element_ >= 0 && now[0] >= smallest_) return;
  smallest_ = now[0];
  element_ = static_cast<int>(now[1]);
  time_ = state.t;
}

}  // namespace orthodyn
