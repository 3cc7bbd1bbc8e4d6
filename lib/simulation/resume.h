// Going on from a checkpoint: whether it fits the scene, and what follows from it.
#pragma once

#include "lib/simulation/checkpoint.h"
#include "lib/simulation/run.h"
#include "lib/simulation/setup.h"
#include "lib/simulation/result_folder.h"

namespace orthodyn {

// Integrators estimate these from the scene where it leaves them open; a longer run must not change them.
void keep_scales(const Checkpoint& checkpoint, Config& scene);

// A checkpoint for a run that begins. Throws RunError if a file that the scene names is gone by now.
Checkpoint first_checkpoint(const Setup& setup, const std::string& resolved, const ResultFolder& folder);

// The same run, continued: with the scene as it is now and one restart more. Throws ConfigError, naming
// what differs, if the checkpoint is that of another simulation.
Checkpoint continued(Checkpoint checkpoint, const Setup& setup, const std::string& resolved,
                     const ResultFolder& folder);

// The end was reached before.
bool is_complete(const Checkpoint& checkpoint, const Scene& scene);

// Output times in the rhythm with which the run began.
Plan plan_of(const Scene& scene, const OutputRhythm& rhythm);

}  // namespace orthodyn
