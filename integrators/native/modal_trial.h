// A trial run of `modal`, which tells how much of a motion a number of modes leaves out.
#pragma once

#include <optional>

#include "integrators/error_control.h"
#include "lib/ode/integrator.h"

namespace orthodyn {

// As ModalTruncation has them: without dimension, in the mass norm, of the largest displacement and velocity.
struct ModalTrial {
  double displacement_left_out = 0, velocity_left_out = 0;
  long steps = 0;
};

// Runs `task` with the `modes` lowest modes, the options and the step limits of a run; there are no outputs.
// None if it takes more than `most_steps`. Shares of 1 if the modes miss the motion of the initial state.
// Precondition: the model is linear and symmetric, and one process holds it. Throws ConfigError where modes cannot
// serve it, RunError and RecoverableError as a run does.
std::optional<ModalTrial> try_modal(const Model& model, const Task& task, const ErrorControl& control, int modes,
                                    long most_steps);

}  // namespace orthodyn
