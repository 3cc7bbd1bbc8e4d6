// One scene, integrated several times undisturbed for its cost, then once with everything that looks on
// for its errors and drifts.
#pragma once

#include <filesystem>
#include <memory>
#include <vector>

#include "lib/simulation/balance.h"
#include "lib/simulation/run.h"
#include "lib/simulation/setup.h"
#include "lib/study/compare/point_result.h"

namespace orthodyn {

class Measurement {
 public:
  // Trajectories that are to be kept go to `folder`.
  Measurement(Setup setup, const Job& job, std::filesystem::path folder);

  // What comparison_json() knows as a point. A run that fails is a result. Throws RunError if a reference
  // cannot be read or a trajectory not be written.
  Json result();

 private:
  void describe_model();
  bool take_exact_solution();
  bool time_runs();
  void watch_run();
  bool run_once(const std::vector<Observer*>& observers, const Plan& plan, Integrator& integrator, double seconds,
                Outcome& outcome);
  void record_timing(const std::vector<double>& wall, const std::vector<double>& cpu,
                     const std::vector<Statistics>& statistics);
  void record_drift(const EnergyMeter& energy, const MomentumMeter& momentum);
  void compare(const Trajectory& trajectory);
  void fail(const std::string& reason, const std::string& message);
  std::unique_ptr<Integrator> fresh_integrator() const;

  Setup setup_;
  std::shared_ptr<const IntegratorChoice> integrator_;  // with what the set-up decided: nothing is estimated again
  Job job_;
  std::filesystem::path folder_;
  std::vector<double> times_;
  Json result_;
};

}  // namespace orthodyn
