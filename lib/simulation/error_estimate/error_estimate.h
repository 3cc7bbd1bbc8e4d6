// How far a run is from the solution, by a second one that is more accurate: at a tenth of rtol, or with
// half the step and Richardson's extrapolation (Hairer, Norsett & Wanner 1993, II.4).
//
// What is left of the second run's own error, some sixth for rtol / 10, makes the estimate a figure of
// the right size, no bound. Errors that both runs share, of the mesh and the model, are not in it.
#pragma once

#include <atomic>
#include <memory>
#include <string>
#include <vector>

#include "lib/ode/integrator.h"
#include "lib/simulation/error_estimate/error_norms.h"
#include "lib/simulation/error_estimate/trajectory.h"
#include "lib/simulation/run/run.h"
#include "lib/simulation/run/setup.h"

namespace orthodyn {

struct ErrorEstimate {
  bool completed = false;
  std::string failure_reason;         // why not completed
  std::string against;                // what the second run had: "integrator.rtol=1e-05"
  ErrorNorms displacement, velocity;  // mass norm relative to the largest; NaN where nothing moves
  int samples = 0;                    // times that were compared, the initial one included
  double wall_seconds = 0;
};

// How many states of two runs fit into so many bytes: 200, which tell as much as thousands, or fewer of a
// large model; 2 at least.
std::size_t samples_within(double bytes, std::size_t unknowns);

class ErrorEstimator {
 public:
  // `setup` must outlive it. Throws ConfigError if the plan has no outputs to compare at, or the
  // integrator has neither rtol nor step or refuses the second run's values.
  ErrorEstimator(const Setup& setup, Plan plan);

  // Looks on at the run whose error is asked for.
  Observer& recorder() { return first_; }

  // What the second run changes, as PATH=VALUE.
  const std::vector<std::string>& refinement() const { return refinement_; }

  // After the run has completed: the second run.
  ErrorEstimate estimate(std::vector<Observer*> observers, const std::atomic<bool>& interrupt) const;

 private:
  // Of every so many outputs and the last one.
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
  std::shared_ptr<const IntegratorChoice> refined_;  // of the second run
  bool fixed_step_ = false;
  std::vector<std::string> refinement_;
  std::size_t samples_;
  SampleRecorder first_;
};

}  // namespace orthodyn
