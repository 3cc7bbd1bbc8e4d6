#include "lib/simulation/observers/balance.h"

#include <algorithm>
#include <cmath>

namespace orthodyn {

namespace {

// To the larger of the two; NaN stays.
void raise(double& largest, double value) {
  if (!(value <= largest) && !std::isnan(largest)) largest = value;
}

std::vector<double> kept(const EnergyBalance& e) {
  return {e.kinetic, e.elastic, e.gravitational, e.dissipated, e.loads};
}

EnergyBalance balance_from(const std::vector<double>& e) { return {e[0], e[1], e[2], e[3], e[4]}; }

std::vector<double> kept(const Vec3& x) { return {x[0], x[1], x[2]}; }

Vec3 vector_from(const std::vector<double>& x) { return {x[0], x[1], x[2]}; }

}  // namespace

void PowerIntegral::start(double t, double power) {
  t_ = t;
  last_ = power;
}

void PowerIntegral::advance(double t, double middle, double end) {
  sum_ += (t - t_) / 6 * (last_ + 4 * middle + end);
  t_ = t;
  last_ = end;
}

void PowerIntegral::advance_by_mean(double t, double mean, double end) {
  sum_ += (t - t_) * mean;
  t_ = t;
  last_ = end;
}

void PowerIntegral::restore(const std::vector<double>& kept) {
  t_ = kept[0];
  last_ = kept[1];
  sum_ = kept[2];
}

EnergyMeter::EnergyMeter(const Model& model, const Integrator& integrator, EnergyTimes times)
    : model_(model), integrator_(integrator), times_(times) {}

void EnergyMeter::on_start(const ObservedState& observed) {
  if (model_.traits().dissipative) dissipation_.start(observed.t(), observed.evaluate("power.dissipated")[0]);
  if (model_.traits().loaded) load_work_.start(observed.t(), observed.evaluate("power.loads")[0]);
  take_energies(observed);
  first_ = last_;
  drift_ = 0;
}

void EnergyMeter::on_step(const StepInfo&, const ObservedState& observed, const Integrator&) {
  if (times_ == EnergyTimes::steps) return look(observed);
  advance_powers(observed);
  // Outputs may all fall on moments of little energy.
  scale_ = std::max(scale_, observed.evaluate("energy.kinetic")[0]);
}

void EnergyMeter::look(const ObservedState& observed) {
  advance_powers(observed);
  take_energies(observed);
}

void EnergyMeter::take_energies(const ObservedState& observed) {
  const auto energy = [&](const char* name) { return observed.evaluate(name)[0]; };
  time_ = observed.t();
  last_ = {energy("energy.kinetic"), energy("energy.elastic"), energy("energy.gravitational"),
           dissipation_.value(), load_work_.value()};
  raise(drift_, std::abs(change()));
  scale_ = std::max({scale_, last_.kinetic, last_.elastic});
}

void EnergyMeter::advance_powers(const ObservedState& observed) {
  const Traits& traits = model_.traits();
  const double t = observed.t();
  if ((!traits.dissipative && !traits.loaded) || t <= powers_time()) return;
  State state;
  const auto mean = integrator_.mean_state();
  if (mean) state = *mean;
  else integrator_.interpolate(0.5 * (powers_time() + t), state);
  const ObservedState middle(model_, state);
  const auto advance = [&](PowerIntegral& integral, const char* power) {
    const double there = middle.evaluate(power)[0], end = observed.evaluate(power)[0];
    if (mean) integral.advance_by_mean(t, there, end);
    else integral.advance(t, there, end);
  };
  if (traits.dissipative) advance(dissipation_, "power.dissipated");
  if (traits.loaded) advance(load_work_, "power.loads");
}

void EnergyMeter::save(Archive& archive) {
  archive.put("dissipation", dissipation_.kept());
  archive.put("load_work", load_work_.kept());
  archive.put("first", kept(first_));
  archive.put("last", kept(last_));
  archive.put("time", time_);
  archive.put("drift", drift_);
  archive.put("scale", scale_);
}

void EnergyMeter::restore(const Archive& archive) {
  dissipation_.restore(archive.numbers("dissipation", 3));
  load_work_.restore(archive.numbers("load_work", 3));
  first_ = balance_from(archive.numbers("first", 5));
  last_ = balance_from(archive.numbers("last", 5));
  if (archive.entries().contains("time")) time_ = archive.number("time");  // earlier checkpoints have none
  drift_ = archive.number("drift");
  scale_ = archive.number("scale");
}

void MomentumMeter::on_start(const ObservedState& observed) {
  look(observed);
  first_linear_ = linear_;
  first_angular_ = angular_;
  linear_drift_ = angular_drift_ = 0;
}

void MomentumMeter::look(const ObservedState& observed) {
  const auto vector = [&](const char* name) {
    const auto values = observed.evaluate(name);
    return Vec3(values[0], values[1], values[2]);
  };
  linear_ = vector("momentum.linear");
  angular_ = vector("momentum.angular");
  raise(linear_drift_, (linear_ - first_linear_).norm());
  raise(angular_drift_, (angular_ - first_angular_).norm());
}

void MomentumMeter::save(Archive& archive) {
  archive.put("linear", kept(linear_));
  archive.put("angular", kept(angular_));
  archive.put("first_linear", kept(first_linear_));
  archive.put("first_angular", kept(first_angular_));
  archive.put("linear_drift", linear_drift_);
  archive.put("angular_drift", angular_drift_);
}

void MomentumMeter::restore(const Archive& archive) {
  linear_ = vector_from(archive.numbers("linear", 3));
  angular_ = vector_from(archive.numbers("angular", 3));
  first_linear_ = vector_from(archive.numbers("first_linear", 3));
  first_angular_ = vector_from(archive.numbers("first_angular", 3));
  linear_drift_ = archive.number("linear_drift");
  angular_drift_ = archive.number("angular_drift");
}

void InversionWatch::save(Archive& archive) {
  archive.put("smallest", smallest_);
  archive.put("time", time_);
  archive.put("element", element_);
}

void InversionWatch::restore(const Archive& archive) {
  smallest_ = archive.number("smallest");
  time_ = archive.number("time");
  element_ = static_cast<int>(archive.count("element"));
}

void InversionWatch::look(const ObservedState& observed) {
  const auto now = observed.evaluate("det_f.smallest");
  if (element_ >= 0 && now[0] >= smallest_) return;
  smallest_ = now[0];
  element_ = static_cast<int>(now[1]);
  time_ = observed.t();
}

}  // namespace orthodyn
