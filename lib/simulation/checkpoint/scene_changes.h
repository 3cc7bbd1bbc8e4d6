// Finds differences between the scene in a checkpoint and the scene of the resumed run.
#pragma once

#include <string>
#include <vector>

#include "lib/config/config.h"

namespace orthodyn {

// A resolved scene, possibly of an earlier version of orthodyn, with defaults for missing keys.
Config with_defaults(const Config& scene);

// Paths of values that differ, in the order of `now`. Numbers are compared with their units. A key without a value
// counts as absent. Explanations by the program (`integrator.kept`, `integrator.because`) are ignored.
std::vector<std::string> changed_keys(const Config& before, const Config& now);

// Changes that a resumed run must not make: all except those of time.end, checkpoint, expect, threads,
// output.accumulated_error, and limits of the integrator that do not affect its accuracy.
std::vector<std::string> refused_changes(const std::vector<std::string>& changed);

}  // namespace orthodyn
