// An observer is called with the states of a run; it writes frames, tables or progress. Quantities computed from a
// state are shared by all observers.
#pragma once

#include "lib/ode/event.h"
#include "lib/ode/integrator.h"
#include "lib/simulation/checkpoint/archive.h"

namespace orthodyn {

class Observer {
 public:
  virtual ~Observer() = default;

  // At the initial state.
  virtual void on_start(const ObservedState&) {}

  // In place of on_start where a run goes on from a checkpoint, after restore().
  virtual void on_resume(const ObservedState&) {}

  // At each output time, within the last step.
  virtual void on_output(const ObservedState&) {}

  // At each time of the history (output.history; the output times where none is given), within the last step.
  virtual void on_history(const ObservedState&) {}

  // At each event, within the last step, in the order of time with the outputs.
  virtual void on_event(const Crossing&) {}

  // After each step, and after the outputs that fell into it: the state at its end.
  // `integrator.interpolate` works for times within the step.
  virtual void on_step(const StepInfo&, const ObservedState&, const Integrator&) {}

  // When the run is over, however it ended.
  virtual void on_end() noexcept {}

  // Saves what another process needs to continue from here: sums, extremes, lengths of files. Files written so far are
  // flushed to the disk. Called between steps only. Throws RunError.
  virtual void save(Archive&) {}

  // Restores what save() has saved, and checks that the files are at least as long as then. Changes no file. Throws
  // ConfigError.
  virtual void restore(const Archive&) {}
};

}  // namespace orthodyn
