// What a model consists of, for results.
#pragma once

#include "lib/simulation/run_result.h"
#include "lib/simulation/setup.h"

namespace orthodyn {

ModelSummary summarize(const Setup& setup);

}  // namespace orthodyn
