#include "lib/simulation/output/balance.h"

#include <algorithm>
#include <cmath>

#include "lib/ode/hermite.h"

namespace orthodyn {

namespace {

// Raises `largest` to `value`; keeps NaN.
void raise(double& largest, double value) {
  if (!(value <= largest) && !std::isnan(largest)) largest = value;
}

std::vector<double> archived(const EnergyBalance& e) {
  return {e.kinetic, e.elastic, e.gravitational, e.dissipated, e.loads};
}

EnergyBalance balance_from(const std::vector<double>& e) { return {e[0], e[1], e[2], e[3], e[4]}; }

std::vector<double> archived(const Vec3& x) { return {x[0], x[1], x[2]}; }

Vec3 vector_from(const std::vector<double>& x) { return {x[0], x[1], x[2]}; }

}  // namespace

EnergyMeter::EnergyMeter(const Model& model, const Integrator& integrator, EnergyTimes times)
    : model_(model), integrator_(integrator), times_(times) {}

void EnergyMeter::on_start(const ObservedState& observed) {
  powers_time_ = observed.t();
  evaluate_energies(observed);
  first_ = last_;
  drift_ = 0;
}

void EnergyMeter::on_step(const StepInfo&, const ObservedState& observed, const Integrator&) {
  if (times_ == EnergyTimes::steps) return observe(observed);
  advance_powers(observed.t());
  // Evaluated at each step, because all outputs may fall on times of little kinetic energy.
  scale_ = std::max(scale_, observed.evaluate("energy.kinetic")[0]);
}

void EnergyMeter::observe(const ObservedState& observed) {
  advance_powers(observed.t());
  evaluate_energies(observed);
}

void EnergyMeter::evaluate_energies(const ObservedState& observed) {
  const auto energy = [&](const char* name) { return observed.evaluate(name)[0]; };
  ++states_;
  time_ = observed.t();
  last_ = {energy("energy.kinetic"), energy("energy.elastic"), energy("energy.gravitational"), dissipated_, load_work_};
  raise(drift_, std::abs(change()));
  scale_ = std::max({scale_, last_.kinetic, last_.elastic});
}

void EnergyMeter::advance_powers(double t) {
  const Traits& traits = model_.traits();
  const double begin = powers_time_, h = t - begin;
  if ((!traits.dissipative && !traits.loaded) || h <= 0) return;
  powers_time_ = t;
  if (const auto mean = integrator_.mean_state()) return advance_by_means(*mean, begin, t);
  const double part = h / smooth_parts(integrator_, h);
  for (double done = 0; done < h - part / 2; done += part) add_work(begin + done, part);
}

// Two-point Gauss quadrature along the cubic through the positions at the Gauss points and at both ends. Velocities are
// derivatives of the cubic, not those of the integrator: velocities of stiff methods are inaccurate, within the
// tolerance, in the stiffest modes, and the dissipation computed from their squares would exceed the energy lost.
// Powers are not evaluated at the ends, where velocities of supports may jump.
void EnergyMeter::add_work(double begin, double duration) {
  const double root = std::sqrt(3.0), early = (1 - 1 / root) / 2;
  State first, last, at[2];
  integrator_.interpolate(begin, first);
  integrator_.interpolate(begin + early * duration, at[0]);
  integrator_.interpolate(begin + (1 - early) * duration, at[1]);
  integrator_.interpolate(begin + duration, last);
  const Vector change = last.q - first.q, bend = root * (at[0].q + at[1].q - first.q - last.q);
  at[0].v = (change + bend) / duration;
  at[1].v = (change - bend) / duration;
  for (const State& state : at) {
    const ObservedState observed(model_, state);
    dissipated_ += duration / 2 * dissipation(observed);
    load_work_ += duration / 2 * load_power(observed);
  }
}

// The force of a motor may change much within a long step. The dissipation is divided evenly: dense output oscillates
// in stiff modes.
void EnergyMeter::advance_by_means(const State& whole, double begin, double t) {
  constexpr double kEnd = 1 - 1e-9;
  if (whole.t != step_.middle) step_ = {whole.t, begin, load_work_};
  const ObservedState observed(model_, whole);
  dissipated_ += (t - begin) * dissipation(observed);
  const double part = t - step_.begin;
  if (part >= kEnd * 2 * (whole.t - step_.begin)) {
    load_work_ = step_.load_work + part * load_power(observed);
    return;
  }
  State first, last;
  integrator_.interpolate(step_.begin, first);
  integrator_.interpolate(t, last);
  State mean = mean_state({first.t, first.q, first.v, {}, first.lambda}, {last.t, last.q, last.v, {}, last.lambda});
  mean.z = whole.z;
  load_work_ = step_.load_work + part * load_power(ObservedState(model_, mean));
}

double EnergyMeter::dissipation(const ObservedState& at) const {
  return model_.traits().dissipative ? at.evaluate("power.dissipated")[0] : 0;
}

double EnergyMeter::load_power(const ObservedState& at) const {
  return model_.traits().loaded ? at.evaluate("power.loads")[0] : 0;
}

std::vector<std::string> EnergyMeter::columns() {
  return {"t [s]", "kinetic [J]", "elastic [J]", "gravitational [J]", "dissipated [J]", "loads [J]", "balance [J]"};
}

std::vector<double> EnergyMeter::row(double t) const {
  return {t, last_.kinetic, last_.elastic, last_.gravitational, last_.dissipated, last_.loads, change()};
}

void EnergyMeter::save(Archive& archive) {
  archive.put("powers", {powers_time_, dissipated_, load_work_});
  archive.put("first", archived(first_));
  archive.put("last", archived(last_));
  archive.put("time", time_);
  archive.put("drift", drift_);
  archive.put("scale", scale_);
  archive.put_count("states", states_);
}

void EnergyMeter::restore(const Archive& archive) {
  const auto& powers = archive.numbers("powers", 3);
  powers_time_ = powers[0], dissipated_ = powers[1], load_work_ = powers[2];
  first_ = balance_from(archive.numbers("first", 5));
  last_ = balance_from(archive.numbers("last", 5));
  time_ = archive.number("time");
  drift_ = archive.number("drift");
  scale_ = archive.number("scale");
  states_ = archive.count("states");
}

void MomentumMeter::on_start(const ObservedState& observed) {
  observe(observed);
  first_linear_ = linear_;
  first_angular_ = angular_;
  linear_drift_ = angular_drift_ = 0;
}

void MomentumMeter::observe(const ObservedState& observed) {
  const auto vector = [&](const char* name) {
    const auto values = observed.evaluate(name);
    return Vec3(values[0], values[1], values[2]);
  };
  linear_ = vector("momentum.linear");
  angular_ = vector("momentum.angular");
  raise(linear_drift_, (linear_ - first_linear_).norm());
  raise(angular_drift_, (angular_ - first_angular_).norm());
}

std::vector<std::string> MomentumMeter::columns() {
  return {"t [s]",
          "linear.x [kg m/s]",
          "linear.y [kg m/s]",
          "linear.z [kg m/s]",
          "angular.x [kg m^2/s]",
          "angular.y [kg m^2/s]",
          "angular.z [kg m^2/s]"};
}

std::vector<double> MomentumMeter::row(double t) const {
  return {t, linear_[0], linear_[1], linear_[2], angular_[0], angular_[1], angular_[2]};
}

void MomentumMeter::save(Archive& archive) {
  archive.put("linear", archived(linear_));
  archive.put("angular", archived(angular_));
  archive.put("first_linear", archived(first_linear_));
  archive.put("first_angular", archived(first_angular_));
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
  element_ = static_cast<int>(archive.number("element"));  // -1 without elements
}

void InversionWatch::observe(const ObservedState& observed) {
  const auto now = observed.evaluate("det_f.smallest");
  if (element_ >= 0 && now[0] >= smallest_) return;
  smallest_ = now[0];
  element_ = static_cast<int>(now[1]);
  time_ = observed.t();
}

}  // namespace orthodyn
