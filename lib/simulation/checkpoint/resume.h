// Whether a checkpoint fits the scene that is to go on from it, and what the run then begins with.
#pragma once

#include "lib/simulation/checkpoint/checkpoint.h"
#include "lib/simulation/output/result_folder.h"
#include "lib/simulation/run/run.h"
#include "lib/simulation/run/setup.h"

namespace orthodyn {

// Scales that integrators estimate from the scene where it leaves them open, and corotational kinematics that were
// taken for `auto`: a run that goes on must not change them.
void keep_choices(const Checkpoint& checkpoint, Config& scene);

// Whether linear kinematics were taken for `auto`.
bool was_linear_so_far(const Checkpoint& checkpoint);

// A checkpoint for a run that begins. Throws RunError if a file that the scene names is gone by now.
Checkpoint first_checkpoint(const Setup& setup, const std::string& resolved, const ResultFolder& folder);

// The same run, continued: with the scene as it is now and one restart more. Throws ConfigError, naming
// what differs, if the checkpoint is that of another simulation.
Checkpoint continued(Checkpoint checkpoint, const Setup& setup, const std::string& resolved,
                     const ResultFolder& folder);

// The end was reached before.
bool is_complete(const Checkpoint& checkpoint, const Scene& scene);

// Output times at the interval with which the run began.
Plan plan_of(const Scene& scene, const OutputSchedule& schedule);

}  // namespace orthodyn
