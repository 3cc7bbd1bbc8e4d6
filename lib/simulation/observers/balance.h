// What a trajectory should keep, followed over all steps: energy with what was dissipated and put in,
// linear and angular momentum, and positive volumes. They write nothing.
#pragma once

#include <vector>

#include "lib/simulation/observers/observer.h"

namespace orthodyn {

// The integral of a power (W) over time, J: Simpson's rule from each time to the next.
class PowerIntegral {
 public:
  void start(double t, double power);
  // To a later time; the power in the middle and there.
  void advance(double t, double middle, double end);
  double time() const { return t_; }
  double value() const { return sum_; }
  std::vector<double> kept() const { return {t_, last_, sum_}; }
  void restore(const std::vector<double>& kept);

 private:
  double t_ = 0, last_ = 0, sum_ = 0;
};

struct EnergyBalance {
  double kinetic = 0, elastic = 0, gravitational = 0;  // J
  double dissipated = 0, loads = 0;                    // J since the start
  // Total plus dissipated less the work of loads: constant, but for the error of the integration.
  double balance() const { return kinetic + elastic + gravitational + dissipated - loads; }
};

class EnergyMeter : public Observer {
 public:
  // `integrator` is the one that is run; both must outlive this. Powers are integrated, on the integrator's dense
  // output, only where they can differ from zero.
  EnergyMeter(const Model& model, const Integrator& integrator);
  void on_start(const State& state) override;
  void on_output(const State& state) override { look(state); }
  void on_step(const StepInfo&, const State& state, const Integrator&) override { look(state); }
  void save(Archive& archive) override;
  void restore(const Archive& archive) override;

  const EnergyBalance& last() const { return last_; }
  // Of the last state looked at, J.
  double change() const { return last_.balance() - first_.balance(); }
  // max |change| over all steps, and the largest kinetic or elastic energy, J.
  double drift() const { return drift_; }
  double scale() const { return scale_; }
  double relative_drift() const { return scale_ > 0 ? drift_ / scale_ : 0; }

 protected:
  // To a state within the integrator's last step.
  void look(const State& state);

 private:
  double powers_time() const { return model_.traits().dissipative ? dissipation_.time() : load_work_.time(); }
  void advance_powers(double t, const StateView& at);
  void look(double t, const StateView& at);

  const Model& model_;
  const Integrator& integrator_;
  PowerIntegral dissipation_, load_work_;
  EnergyBalance first_, last_;
  double drift_ = 0, scale_ = 0;
};

// Linear and angular momentum about the origin, kg m/s and kg m^2/s.
class MomentumMeter : public Observer {
 public:
  explicit MomentumMeter(const Model& model) : model_(model) {}
  void on_start(const State& state) override;
  void on_output(const State& state) override { look(state); }
  void on_step(const StepInfo&, const State& state, const Integrator&) override { look(state); }
  void save(Archive& archive) override;
  void restore(const Archive& archive) override;

  // Of the last state looked at.
  const Vec3& linear() const { return linear_; }
  const Vec3& angular() const { return angular_; }
  // Largest change over all steps, and the initial size.
  double linear_drift() const { return linear_drift_; }
  double angular_drift() const { return angular_drift_; }
  double linear_scale() const { return first_linear_.norm(); }
  double angular_scale() const { return first_angular_.norm(); }

 protected:
  void look(const State& state);

 private:
  const Model& model_;
  Vec3 linear_ = Vec3::Zero(), angular_ = Vec3::Zero();
  Vec3 first_linear_ = Vec3::Zero(), first_angular_ = Vec3::Zero();
  double linear_drift_ = 0, angular_drift_ = 0;
};

// The smallest det F over all steps: an element with det F <= 0 is inverted.
class InversionWatch : public Observer {
 public:
  explicit InversionWatch(const Model& model) : model_(model) {}
  void on_start(const State& state) override { look(state); }
  void on_step(const StepInfo&, const State& state, const Integrator&) override { look(state); }
  void save(Archive& archive) override;
  void restore(const Archive& archive) override;

  double smallest() const { return smallest_; }
  int element() const { return element_; }
  double time() const { return time_; }

 private:
  void look(const State& state);
  const Model& model_;
  double smallest_ = 1, time_ = 0;
  int element_ = -1;
};

}  // namespace orthodyn
