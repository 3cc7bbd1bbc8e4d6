// Checks that a checkpoint matches the scene, and prepares the resumed run.
#pragma once

#include "lib/simulation/checkpoint/checkpoint.h"
#include "lib/simulation/output/result_folder.h"
#include "lib/simulation/run/run.h"
#include "lib/simulation/run/setup.h"

namespace orthodyn {

// Copies automatic choices of the earlier run into the scene: scales estimated by the integrator, the method of `auto`,
// and regions that became corotational. A resumed run must not change them.
void keep_choices(const Checkpoint& checkpoint, Config& scene);

// True if `kinematics: auto` chose linear kinematics for some region of the earlier run.
bool was_linear(const Checkpoint& checkpoint);

// First checkpoint of a new run. Throws RunError if a file named in the scene has disappeared.
Checkpoint first_checkpoint(const Setup& setup, const std::string& resolved, const ResultFolder& folder);

// First checkpoint of a resumed run: `checkpoint` with the present scene and one more restart. Throws ConfigError if
// `checkpoint` belongs to another simulation, naming the differences, or if the scene ends before it.
Checkpoint resumed_checkpoint(Checkpoint checkpoint, const Setup& setup, const std::string& resolved,
                              const ResultFolder& folder);

// True if the end of the scene's time span has been reached.
bool is_complete(const Checkpoint& checkpoint, const Scene& scene);

// The plan of a run. `schedule`: output times of the first run, whose interval is kept.
Plan plan_of(const Scene& scene, const OutputSchedule& schedule);

}  // namespace orthodyn
