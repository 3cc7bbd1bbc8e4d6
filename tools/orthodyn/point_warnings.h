// What a finished sweep warns of: coarse meshes, and what its points told of their scenes.
#pragma once

#include "lib/simulation/output/json.h"

namespace orthodyn::study::sweep {

// To stderr. `table`: sweep_json(). The slips of the first point are taken to be told before the run.
void tell_warnings_of_points(const Json& table);

}  // namespace orthodyn::study::sweep
