// A trial run of `modal`, which measures the share of the motion that a given number of modes leaves out.
#pragma once

#include <optional>

#include "integrators/error_control.h"
#include "lib/ode/integrator.h"

namespace orthodyn {

// Result of a trial run; the shares are those of ModalTruncation.
struct ModalTrial {
  double displacement_left_out = 0, velocity_left_out = 0;
  long steps = 0;
};

// Runs `task` with the `modes` lowest modes and without outputs. Returns nothing if the run takes more than
// `most_steps` steps. Returns shares of 1 if the modes do not contain the motion that the initial state and loads
// cause. Precondition: the model is linear and symmetric, on one process. Throws ConfigError if the modes cannot be
// used. Throws RunError or RecoverableError for the same reasons as a run with `modal`.
std::optional<ModalTrial> try_modal(const Model& model, const Task& task, const ErrorControl& control, int modes,
                                    long most_steps);

}  // namespace orthodyn
