// Observers receive the states of a run, and write frames, tables or progress. Quantities computed from a state are
// shared by all observers.
#pragma once

#include "lib/ode/event.h"
#include "lib/ode/integrator.h"
#include "lib/simulation/checkpoint/archive.h"

namespace orthodyn {

class Observer {
 public:
  virtual ~Observer() = default;

  // Called at the initial state.
  virtual void on_start(const ObservedState&) {}

  // Called instead of on_start() in a resumed run, after restore().
  virtual void on_resume(const ObservedState&) {}

  // Called at each output time; the time lies within the last step.
  virtual void on_output(const ObservedState&) {}

  // Called at each time of the history (output.history; default: the output times); the time lies within the last step.
  virtual void on_history(const ObservedState&) {}

  // Called at each event, in order of time with the outputs; the event lies within the last step.
  virtual void on_event(const Crossing&) {}

  // Called after each step and its outputs, with the state at the end of the step. `integrator.interpolate` is valid
  // within the step.
  virtual void on_step(const StepInfo&, const ObservedState&, const Integrator&) {}

  // Called when the run has ended in any way.
  virtual void on_end() noexcept {}

  // Saves what another process needs to resume: sums, extremes, lengths of files. Files written so far are synced to
  // the disk. Called between steps only. Throws RunError.
  virtual void save(Archive&) {}

  // Restores a saved state, and checks that files are at least as long as when it was saved. Changes no file. Throws
  // ConfigError.
  virtual void restore(const Archive&) {}
};

}  // namespace orthodyn
