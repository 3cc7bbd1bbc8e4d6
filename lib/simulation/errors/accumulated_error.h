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

#include "lib/simulation/observers/observer.h"
#include "lib/simulation/setup.h"

namespace orthodyn {

struct AccumulatedError {
  double error = 0;          // of displacements, relative to the largest, in the mass norm
  int parts = 0, steps = 0;  // that were looked at; and how many steps each has
  std::string against;      // by what: "arkode_dirk at rtol 1e-05"
  double wall_seconds = 0;
};

// Keeps the ends of parts that are spread evenly over the steps of a run.
class PartRecorder : public Observer {
 public:
  struct Part {
    State begin, end;
    double decay = 0;  // 1/s, of the amplitude of vibrations
  };

  // `model` must outlive it.
  explicit PartRecorder(const Model& model) : model_(model) {}
  void on_start(const ObservedState& observed) override { measure(observed); }
  void on_resume(const ObservedState& observed) override { measure(observed); }
  void on_step(const StepInfo& info, const ObservedState& observed, const Integrator&) override;

  const std::deque<Part>& parts() const { return parts_; }
  double displacement() const { return displacement_; }  // the largest |u|_M that was seen, sqrt(kg) m

  static constexpr int kSteps = 10;  // of a part

 private:
  void measure(const ObservedState& observed);
  void begin_part(const ObservedState& observed);

  const Model& model_;
  std::deque<Part> parts_;
  std::optional<Part> open_;
  long step_ = 0, stride_ = 500, opened_at_ = 0;
  double displacement_ = 0;
};

// After a run of so many steps has reached `end`, s. None if it was too short, if nothing moves, or if a part cannot be
// integrated again.
std::optional<AccumulatedError> accumulated_error(const Setup& setup, const PartRecorder& recorder, long steps,
                                                  double end, const std::atomic<bool>& interrupt);

}  // namespace orthodyn
