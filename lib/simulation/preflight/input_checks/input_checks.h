// Warns of input values that are valid but probably not intended, most often errors of unit or magnitude. Each warning
// names the place, the value and the most likely error. The checks do not change the computation.
//
// Most rules compare values of the scene with each other, such as the duration of a ramp with that of the run, so that
// dimensionless scenes pass. The others are bounds that no real solid exceeds.
#pragma once

#include "lib/analysis/static_response.h"
#include "lib/config/config.h"
#include "lib/scene/build.h"

namespace orthodyn {

// `config`: the resolved input of the scene. `is_timed`: false if the user gave no time span.
Warnings check_inputs(const Config& config, const Scene& scene, const BuiltScene& built, bool is_timed = true);

// Checks the linear static response to the loads. Throws ConfigError if the displacement is so large that no solid
// could be so soft.
Warnings check_response(const Config& config, const Scene& scene, const BuiltScene& built,
                        const StaticResponse& statics);

// Largest number of unknowns for which the static response is computed if only check_response() needs it.
constexpr int kMaxUnknownsOfResponse = 30'000;

// Builds the scene and returns the warnings of check_inputs() and check_response(). For studies, whose points run in
// other processes. Empty if the scene cannot be built; the points then report the error.
Warnings scene_warnings(const Config& scene, bool is_timed = true);

}  // namespace orthodyn
