// What a scene says of its model, key by key, as JSON: materials, both dampings, gravity, loads, terms, clamps, motions
// and the initial state. Figures stand as in the input (SI, or text with a unit), with every default.
#pragma once

#include "lib/config/config.h"
#include "lib/simulation/output/json.h"

namespace orthodyn {

// `resolved`: a scene with every default. Sections that it does not have are left out.
Json model_keys(const Config& resolved);

}  // namespace orthodyn
