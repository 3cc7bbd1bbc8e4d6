// Computes the metrics of one scene. What none of them needs is not computed.
#pragma once

#include <filesystem>

#include "lib/config/config.h"
#include "lib/core/ranks.h"
#include "lib/study/points/evaluation.h"

namespace orthodyn::study {

// The state that the picture shows, in the point's folder.
inline constexpr const char* kFrameFile = "frame.vtu";

// A run that fails is a result. The state for the picture goes to `folder`, if it is wanted. `ranks`: those that
// compute it together, and all call this; null for this process alone. Throws ConfigError, RunError.
EvaluationResult evaluate_point(const Config& scene, const EvaluationInput& input, const std::filesystem::path& folder,
                                const Ranks* ranks = nullptr);

// Does the job of a folder. Throws as serve_job() does.
void evaluate_point(const std::filesystem::path& folder, const Ranks* ranks);

}  // namespace orthodyn::study
