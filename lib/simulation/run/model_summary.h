// Describes the model in results.
#pragma once

#include <string>

#include "lib/simulation/run/run_result.h"
#include "lib/simulation/run/setup.h"

namespace orthodyn {

ModelSummary summarize(const Setup& setup);

// The kinematics chosen for `auto`, the reason, and the error of linear kinematics; "" if not applicable.
std::string kinematics_summary(const Setup& setup);

}  // namespace orthodyn
