// What a model consists of, for results.
#pragma once

#include "lib/fem/fem_model.h"
#include "lib/simulation/run_result.h"

namespace orthodyn {

ModelSummary summarize(const FemModel& model);

}  // namespace orthodyn
