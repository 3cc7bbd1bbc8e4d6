// Something that looks on while a model is integrated: writes frames, curves, progress.
#pragma once

#include "lib/ode/integrator.h"

namespace orthodyn {

class Observer {
 public:
  virtual ~Observer() = default;

  // At the initial state.
  virtual void on_start(const State&) {}

  // At each output time, within the last step.
  virtual void on_output(const State&) {}

  // After each step, and after the outputs that fell into it: the state at its end.
  // `integrator.interpolate` works for times within the step.
  virtual void on_step(const StepInfo&, const State&, const Integrator&) {}

  // When the run is over, however it ended.
  virtual void on_end() noexcept {}
};

}  // namespace orthodyn
