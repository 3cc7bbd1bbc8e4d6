// How far the errors of a long run's steps may have added up: measured on a few short parts of the run, each of which
// is integrated again, more accurately, from the run's own state at its begin.
//
// The differences at the ends of the parts, per step, are those of all steps; they are added up without a sign, as
// those of a phase do, and die away as fast as the vibrations do by what damping takes. A difference of velocities
// counts by the displacements that it leads to until the end: little, where it is of fast vibrations; all the way,
// where no stiffness turns it back. A figure of the right size for motions that repeat themselves, no bound: too small
// where neighbouring motions part exponentially, too large where errors of steps cancel.
#pragma once

#include <atomic>
#include <deque>
#include <optional>
#include <string>

#include "lib/simulation/output/observer.h"
#include "lib/simulation/run/setup.h"

namespace orthodyn {

struct AccumulatedError {
  double error = 0;          // of displacements, relative to the largest, in the mass norm
  int parts = 0, steps = 0;  // that were looked at; and how many steps each has
  double since = 0;          // s: the start, or where the run was resumed
  std::string against;       // by what: "arkode_dirk at rtol 1e-05"
  double wall_seconds = 0;
};

// Keeps the ends of parts that are spread evenly over the steps of a run.
class PartRecorder : public Observer {
 public:
  struct Part {
    State begin, end;
  };

  // `model` must outlive it.
  explicit PartRecorder(const Model& model) : model_(model) {}
  void on_start(const ObservedState& observed) override { start(observed); }
  void on_resume(const ObservedState& observed) override { start(observed); }
  void on_output(const ObservedState& observed) override { measure(observed); }
  void on_step(const StepInfo& info, const ObservedState& observed, const Integrator&) override;

  const std::deque<Part>& parts() const { return parts_; }
  double since() const { return since_; }                // s
  long steps() const { return step_; }                   // since then
  double displacement() const { return displacement_; }  // the largest |u|_M that was seen, sqrt(kg) m
  double decay() const;  // 1/s, of the amplitude of vibrations by what damping takes, on average over the parts

  static constexpr int kSteps = 10;  // of a part

 private:
  void start(const ObservedState& observed);
  void measure(const ObservedState& observed);
  void add_powers(const ObservedState& observed);

  const Model& model_;
  std::deque<Part> parts_;
  std::optional<Part> open_;
  long step_ = 0, stride_ = 500, opened_at_ = 0;
  double since_ = 0, displacement_ = 0;
  double dissipated_ = 0, kinetic_ = 0;  // sums, W and J
};

// After the run has reached `end`, s; `run` is its integrator. None if it was too short, if nothing moves, if a part
// cannot be integrated again, or if that would need a large factorisation in a run that had none.
std::optional<AccumulatedError> accumulated_error(const Setup& setup, const Integrator& run,
                                                  const PartRecorder& recorder, double end,
                                                  const std::atomic<bool>& interrupt);

}  // namespace orthodyn
