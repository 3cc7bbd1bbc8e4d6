// What a trajectory should keep: energy with what was dissipated and put in, linear and angular momentum, and positive
// volumes. They write nothing.
#pragma once

#include <cstddef>
#include <vector>

#include "lib/scene/output_files.h"
#include "lib/simulation/output/observer.h"

namespace orthodyn {

struct EnergyBalance {
  double kinetic = 0, elastic = 0, gravitational = 0;  // J
  double dissipated = 0, loads = 0;                    // J since the start
  // Total plus dissipated less the work of loads: constant, but for the error of the integration.
  double balance() const { return kinetic + elastic + gravitational + dissipated - loads; }
};

class EnergyMeter : public Observer {
 public:
  // `integrator` is the one that is run; both must outlive this. The work of forces is integrated over every step along
  // the positions of the integrator's dense output or at its mean state, but only where it can differ from zero.
  EnergyMeter(const Model& model, const Integrator& integrator, EnergyTimes times = EnergyTimes::steps);
  void on_start(const ObservedState& observed) override;
  void on_output(const ObservedState& observed) override { look(observed); }
  void on_step(const StepInfo&, const ObservedState& observed, const Integrator&) override;
  void save(Archive& archive) override;
  void restore(const Archive& archive) override;

  // Of the last state looked at.
  const EnergyBalance& last() const { return last_; }
  double change() const { return last_.balance() - first_.balance(); }  // J
  // max |change|, and the largest kinetic or elastic energy, J.
  double drift() const { return drift_; }
  double scale() const { return scale_; }
  double relative_drift() const { return scale_ > 0 ? drift_ / scale_ : 0; }
  EnergyTimes times() const { return times_; }
  double time() const { return time_; }  // of last(), s
  // How many states were looked at for the drift and the elastic energy.
  std::size_t states() const { return states_; }

 private:
  // To a time within the integrator's last step, s.
  void advance_powers(double t);
  void add_work(double begin, double duration);
  void add_powers(const State& at, double duration);
  void look(const ObservedState& observed);
  void take_energies(const ObservedState& observed);

  const Model& model_;
  const Integrator& integrator_;
  EnergyTimes times_;
  double powers_time_ = 0, dissipated_ = 0, load_work_ = 0;  // s; J up to then
  EnergyBalance first_, last_;
  double time_ = 0, drift_ = 0, scale_ = 0;
  std::size_t states_ = 0;
};

// Linear and angular momentum about the origin, kg m/s and kg m^2/s.
class MomentumMeter : public Observer {
 public:
  void on_start(const ObservedState& observed) override;
  void on_output(const ObservedState& observed) override { look(observed); }
  void on_step(const StepInfo&, const ObservedState& observed, const Integrator&) override { look(observed); }
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

 private:
  void look(const ObservedState& observed);

  Vec3 linear_ = Vec3::Zero(), angular_ = Vec3::Zero();
  Vec3 first_linear_ = Vec3::Zero(), first_angular_ = Vec3::Zero();
  double linear_drift_ = 0, angular_drift_ = 0;
};

// The smallest det F over all steps: an element with det F <= 0 is inverted.
class InversionWatch : public Observer {
 public:
  void on_start(const ObservedState& observed) override { look(observed); }
  void on_step(const StepInfo&, const ObservedState& observed, const Integrator&) override { look(observed); }
  void save(Archive& archive) override;
  void restore(const Archive& archive) override;

  double smallest() const { return smallest_; }
  int element() const { return element_; }
  double time() const { return time_; }

 private:
  void look(const ObservedState& observed);

  double smallest_ = 1, time_ = 0;
  int element_ = -1;
};

}  // namespace orthodyn
