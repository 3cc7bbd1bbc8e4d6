// Runs a fit: searches from all starts, then statistics, refined meshes and candidates.
#pragma once

#include <functional>
#include <string>

#include "lib/study/fit/result.h"

namespace orthodyn::study::fit {

// Messages while a fit runs.
struct FitListener {
  std::function<void(std::size_t attempt, const Iteration& iteration)> on_iteration;
  // A stage begins: "search 2 of 5", "refined meshes".
  std::function<void(const std::string& stage)> on_stage;
};

// Throws ConfigError if a parameter changes no measured quantity, RunError if no search succeeds, Interrupted.
Result run_fit(const Problem& problem, const Fit& fit, JobOptions options, const FitListener& listener);

}  // namespace orthodyn::study::fit
