// Automatic checks of a completed result.
#pragma once

#include <string>
#include <vector>

#include "lib/simulation/run/run_result.h"

namespace orthodyn {

// One sentence for each finding, with its meaning and a remedy: inverted elements, exceeded strains and strengths, a
// residual above its tolerance, a coarse mesh, loads or peaks that steps may have missed, large errors of linear
// kinematics or of the integration, an energy drift above 1 %, and warnings of the integrator.
std::vector<std::string> result_warnings(const RunResult& result);

}  // namespace orthodyn
