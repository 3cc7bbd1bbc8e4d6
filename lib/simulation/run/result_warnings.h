// Automatic checks of a completed result.
#pragma once

#include <string>
#include <vector>

#include "lib/simulation/run/run_result.h"

namespace orthodyn {

// One sentence for each finding, with its meaning and a remedy: inverted elements, a residual above its tolerance, a
// coarse mesh, loads that steps may have missed, a large error of linear kinematics, an energy balance that drifts by
// more than 1 % of the largest energy, a large accumulated integration error, and warnings of the integrator.
std::vector<std::string> result_warnings(const RunResult& result);

}  // namespace orthodyn
