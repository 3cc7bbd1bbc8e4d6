// Estimates the time-integration error of a run by a second, more accurate run: with rtol / 10, or with half the step
// and Richardson extrapolation (Hairer, Norsett & Wanner 1993, II.4).
//
// The estimate is an order of magnitude, not a bound, because the second run has an error, too: for rtol / 10 about one
// sixth of the first run's. Errors of the mesh and the model, which are common to both runs, are not included.
#pragma once

#include <atomic>
#include <memory>
#include <string>
#include <vector>

#include "lib/ode/integrator.h"
#include "lib/simulation/error_estimate/error_norms.h"
#include "lib/simulation/error_estimate/recorders.h"
#include "lib/simulation/run/run.h"
#include "lib/simulation/run/setup.h"

namespace orthodyn {

struct ErrorEstimate {
  bool completed = false;
  std::string failure_reason;         // of the second run; "" if it completed
  std::string against;                // setting of the second run: "integrator.rtol=1e-05"
  ErrorNorms displacement, velocity;  // in the mass norm, relative to the largest norm over time; NaN if nothing moves
  int samples = 0;                    // times compared, including the initial one
  double wall_seconds = 0;
};

// Number of states to record per run, so that the states of both runs fit into `bytes`. At least 2, even if they do not
// fit; at most 200, which is enough.
std::size_t samples_within(double bytes, std::size_t unknowns);

class ErrorEstimator {
 public:
  // `setup` must outlive the estimator. Throws ConfigError if the plan has no outputs, if the integrator has neither
  // rtol nor step, or if it rejects the refined values.
  ErrorEstimator(const Setup& setup, Plan plan);

  // Observes the run whose error is estimated.
  Observer& recorder() { return first_; }

  // Changes of the scene for the second run, as PATH=VALUE.
  const std::vector<std::string>& refinement() const { return refinement_; }

  // Computes the second run. Call after the first run has completed.
  ErrorEstimate estimate(std::vector<Observer*> observers, const std::atomic<bool>& interrupt) const;

 private:
  // Records every n-th output and the last one.
  class SampleRecorder : public Observer {
   public:
    SampleRecorder(std::size_t outputs, std::size_t samples);
    void on_start(const ObservedState& observed) override { samples_.on_start(observed); }
    void on_output(const ObservedState& observed) override;
    void on_step(const StepInfo& info, const ObservedState&, const Integrator&) override { order_ = info.order; }
    const Trajectory& trajectory() const { return samples_.trajectory(); }
    int order() const { return order_; }

   private:
    std::size_t outputs_, stride_, seen_ = 0;
    int order_ = 0;
    TrajectoryRecorder samples_;
  };

  const Setup& setup_;
  Plan plan_;
  std::shared_ptr<const IntegratorChoice> refined_;  // for the second run
  bool fixed_step_ = false;
  std::vector<std::string> refinement_;
  std::size_t samples_;
  SampleRecorder first_;
};

}  // namespace orthodyn
