// What a model consists of, for results.
#pragma once

#include <string>

#include "lib/simulation/run/run_result.h"
#include "lib/simulation/run/setup.h"

namespace orthodyn {

ModelSummary summarize(const Setup& setup);

// What was taken for `kinematics: auto`, and why; "" where the scene says which.
std::string told_kinematics(const Setup& setup);

}  // namespace orthodyn
