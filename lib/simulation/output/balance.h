// Observers of the energy balance, of linear and angular momentum, and of the sign of det F. They write no files.
#pragma once

#include <cstddef>
#include <limits>
#include <string>
#include <vector>

#include "lib/scene/output_files.h"
#include "lib/simulation/output/observer.h"

namespace orthodyn {

struct EnergyBalance {
  double kinetic = 0, elastic = 0, gravitational = 0;  // J
  double dissipated = 0, loads = 0;                    // energy dissipated, work of loads since the start, J
  // Total energy plus dissipation minus work of loads; constant except for the integration error.
  double balance() const { return kinetic + elastic + gravitational + dissipated - loads; }
};

class EnergyMeter : public Observer {
 public:
  // `integrator`: the integrator of the run. Model and integrator must outlive the meter. Unless they are identically
  // zero, the powers of loads and damping are integrated over every step: along the positions of the dense output, or
  // at the integrator's mean state if it has one. Until a time within the step, the mean is then that until this time.
  EnergyMeter(const Model& model, const Integrator& integrator, EnergyTimes times = EnergyTimes::steps);
  void on_start(const ObservedState& observed) override;
  void on_output(const ObservedState& observed) override { observe(observed); }
  void on_step(const StepInfo&, const ObservedState& observed, const Integrator&) override;
  void save(Archive& archive) override;
  void restore(const Archive& archive) override;

  // At the last state observed.
  const EnergyBalance& last() const { return last_; }
  double change() const { return last_.balance() - first_.balance(); }  // J
  // drift(): largest |change()|, J. scale(): largest kinetic or elastic energy, J.
  double drift() const { return drift_; }
  double scale() const { return scale_; }
  double relative_drift() const { return scale_ > 0 ? drift_ / scale_ : 0; }
  // Header and row of energy.csv. The balance is given as its change since the start, which is zero for exact
  // integration.
  static std::vector<std::string> columns();
  std::vector<double> row(double t) const;
  EnergyTimes times() const { return times_; }
  double time() const { return time_; }  // of last(), s
  // Number of states evaluated for the drift and the elastic energy.
  std::size_t states() const { return states_; }

 private:
  // Integrates the powers up to t (s), which lies within the last step.
  void advance_powers(double t);
  void add_work(double begin, double duration);
  // The same from the mean state of the last step, which began at `begin` or at an earlier call.
  void advance_by_means(const State& whole, double begin, double t);
  double dissipation(const ObservedState& at) const;  // W
  double load_power(const ObservedState& at) const;   // W
  void observe(const ObservedState& observed);
  void evaluate_energies(const ObservedState& observed);

  const Model& model_;
  const Integrator& integrator_;
  EnergyTimes times_;
  // The last step with a mean state: times of its middle and its begin (s), work of loads until its begin (J).
  struct Step {
    double middle = -std::numeric_limits<double>::infinity(), begin = 0, load_work = 0;
  };
  double powers_time_ = 0, dissipated_ = 0, load_work_ = 0;  // s; energies until powers_time_, J
  Step step_;
  EnergyBalance first_, last_;
  double time_ = 0, drift_ = 0, scale_ = 0;
  std::size_t states_ = 0;
};

// Linear and angular momentum about the origin, kg m/s and kg m^2/s.
class MomentumMeter : public Observer {
 public:
  void on_start(const ObservedState& observed) override;
  void on_output(const ObservedState& observed) override { observe(observed); }
  void on_step(const StepInfo&, const ObservedState& observed, const Integrator&) override { observe(observed); }
  void save(Archive& archive) override;
  void restore(const Archive& archive) override;

  // At the last state observed.
  const Vec3& linear() const { return linear_; }
  const Vec3& angular() const { return angular_; }
  static std::vector<std::string> columns();
  std::vector<double> row(double t) const;
  // Largest changes over all states, and the initial angular momentum.
  double linear_drift() const { return linear_drift_; }
  double angular_drift() const { return angular_drift_; }
  double angular_scale() const { return first_angular_.norm(); }

 private:
  void observe(const ObservedState& observed);

  Vec3 linear_ = Vec3::Zero(), angular_ = Vec3::Zero();
  Vec3 first_linear_ = Vec3::Zero(), first_angular_ = Vec3::Zero();
  double linear_drift_ = 0, angular_drift_ = 0;
};

// Finds the smallest det F over all steps. An element with det F <= 0 is inverted.
class InversionWatch : public Observer {
 public:
  void on_start(const ObservedState& observed) override { observe(observed); }
  void on_step(const StepInfo&, const ObservedState& observed, const Integrator&) override { observe(observed); }
  void save(Archive& archive) override;
  void restore(const Archive& archive) override;

  double smallest() const { return smallest_; }
  int element() const { return element_; }
  double time() const { return time_; }

 private:
  void observe(const ObservedState& observed);

  double smallest_ = 1, time_ = 0;
  int element_ = -1;
};

}  // namespace orthodyn
