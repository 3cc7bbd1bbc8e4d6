// Estimates the accumulated time-integration error of a long run. A few short segments of the run are integrated again,
// more accurately, from the run's own states at the starts of the segments.
//
// The difference at the end of a segment, divided by the number of its steps, is taken as the error of each step
// nearby. These errors are added without their signs, because phase errors accumulate, and decay as damping reduces the
// vibrations. A velocity error counts as the displacement that it causes until the end of the run: it is small for fast
// vibrations, and largest where no stiffness opposes the motion. The result is an order of magnitude for periodic
// motions, not a bound. It is too small if neighbouring motions diverge exponentially, and too large if local errors
// cancel.
#pragma once

#include <atomic>
#include <deque>
#include <optional>
#include <string>

#include "lib/simulation/output/observer.h"
#include "lib/simulation/run/setup.h"

namespace orthodyn {

struct SegmentErrorEstimate {
  double error = 0;             // relative error of the displacement, in the mass norm
  int segments = 0, steps = 0;  // number of segments; steps of each
  double since = 0;             // start of the run, or time of its resumption, s
  std::string against;          // the more accurate method: "arkode_dirk at rtol 1e-05"
  double wall_seconds = 0;
};

// Records the start and end states of segments spread evenly over the steps of a run.
class SegmentRecorder : public Observer {
 public:
  struct Segment {
    State begin, end;
  };

  // `model` must outlive the recorder.
  explicit SegmentRecorder(const Model& model) : model_(model) {}
  void on_start(const ObservedState& observed) override { start(observed); }
  void on_resume(const ObservedState& observed) override { start(observed); }
  void on_output(const ObservedState& observed) override { measure(observed); }
  void on_step(const StepInfo& info, const ObservedState& observed, const Integrator&) override;

  const std::deque<Segment>& segments() const { return segments_; }
  double since() const { return since_; }                // s
  long steps() const { return step_; }                   // number of steps since since()
  double displacement() const { return displacement_; }  // largest |u|_M observed, sqrt(kg) m
  double decay() const;  // decay rate of vibrations by damping, mean over the segments, 1/s

  static constexpr int kSteps = 10;  // steps in each segment

 private:
  void start(const ObservedState& observed);
  void measure(const ObservedState& observed);
  void add_powers(const ObservedState& observed);

  const Model& model_;
  std::deque<Segment> segments_;
  std::optional<Segment> open_;
  long step_ = 0, stride_ = 500, opened_at_ = 0;
  double since_ = 0, displacement_ = 0;
  double dissipated_ = 0, kinetic_ = 0;  // sums over the ends of segments, W and J
};

// Call after the run has reached `end` (s). `run`: the integrator of the run. Empty if the run was too short, if
// nothing moves, if a segment cannot be integrated again, or if the run used no factorisation and has more than 10,000
// unknowns, so that the second integration would need a large one.
std::optional<SegmentErrorEstimate> segment_error_estimate(const Setup& setup, const Integrator& run,
                                                           const SegmentRecorder& recorder, double end,
                                                           const std::atomic<bool>& interrupt);

}  // namespace orthodyn
