// Curves over time as CSV: energies, momenta, probes, steps. Headers name the units.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "lib/run/files.h"
#include "lib/run/observer.h"

namespace orthodyn {

// Integrates a model's power over the steps of an integrator: Simpson's rule on its dense output.
class PowerIntegral {
 public:
  PowerIntegral(const Model& model, std::string power) : model_(model), power_(std::move(power)) {}
  void start(const State& state);
  // To a time within the integrator's last step.
  double advance(const State& to, const Integrator& integrator);
  double value() const { return sum_; }

 private:
  const Model& model_;
  std::string power_;
  double t_ = 0, last_ = 0, sum_ = 0;
};

struct EnergyBalance {
  double kinetic = 0, elastic = 0, gravitational = 0;  // J
  double dissipated = 0, loads = 0;                    // J since the start
  // Total plus dissipated less the work of loads: constant, but for the error of the integration.
  double balance() const { return kinetic + elastic + gravitational + dissipated - loads; }
};

// energy.csv, its balance relative to the start (zero when exact); also the figures of the summary.
// Powers are integrated only where they can differ from zero.
class EnergyWriter : public Observer {
 public:
  // `integrator` is the one that is run.
  EnergyWriter(const std::filesystem::path& path, const Model& model, const Integrator& integrator, bool dissipates,
               bool loaded);
  void on_start(const State& state) override;
  void on_output(const State& state) override;
  void on_step(const StepInfo& info, const State& state, const Integrator& integrator) override;

  const EnergyBalance& last() const { return last_; }
  // max |balance - first balance| over all steps, and the largest kinetic or elastic energy.
  double drift() const { return drift_; }
  double scale() const { return scale_; }

 private:
  void look(const State& state);
  void write(double t);

  const Model& model_;
  const Integrator& integrator_;
  CsvFile file_;
  bool dissipates_, loaded_;
  PowerIntegral dissipation_, load_work_;
  EnergyBalance first_, last_;
  double drift_ = 0, scale_ = 0;
};

// momentum.csv: linear and angular momentum about the origin.
class MomentumWriter : public Observer {
 public:
  MomentumWriter(const std::filesystem::path& path, const Model& model);
  void on_start(const State& state) override;
  void on_output(const State& state) override;
  void on_step(const StepInfo&, const State& state, const Integrator&) override { look(state); }
  // Largest change of the angular momentum over all steps, kg m^2/s, and its initial size.
  double angular_drift() const { return drift_; }
  double angular_scale() const { return first_.norm(); }

 private:
  Vec3 look(const State& state);
  void write(const State& state);

  const Model& model_;
  CsvFile file_;
  Vec3 first_ = Vec3::Zero();
  double drift_ = 0;
};

// steps.csv: t, h, order, Newton iterations and rejections of each step.
class StepWriter : public Observer {
 public:
  explicit StepWriter(const std::filesystem::path& path);
  void on_step(const StepInfo& info, const State& state, const Integrator& integrator) override;

 private:
  CsvFile file_;
  Statistics before_;
};

// probes.csv: fields at named nodes.
struct ProbeColumn {
  std::string name;   // "tip"
  int node;
  std::string field;   // a node output: "displacement"
  int components = 0;  // of the field; filled in
};

class ProbeWriter : public Observer {
 public:
  ProbeWriter(const std::filesystem::path& path, const Model& model, std::vector<ProbeColumn> columns);
  void on_start(const State& state) override { record(state); }
  void on_output(const State& state) override { record(state); }

 private:
  void record(const State& state);
  const Model& model_;
  std::vector<ProbeColumn> columns_;
  CsvFile file_;
};

}  // namespace orthodyn
