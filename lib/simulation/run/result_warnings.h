// What in a result should not be taken on trust, though it was computed to its end.
#pragma once

#include <string>
#include <vector>

#include "lib/simulation/run/run_result.h"

namespace orthodyn {

// A sentence each: what was found, what it means, what to do. Inverted elements; a residual above its tolerance; a
// coarse mesh; loads that steps may have missed; linear kinematics that are far off; an energy balance that drifts by
// more than a hundredth of the largest energy; errors of a long run that may have added up; what the integrator itself
// doubts.
std::vector<std::string> result_warnings(const RunResult& result);

}  // namespace orthodyn
