// One scene, integrated several times undisturbed for its cost, then once with all observers for its errors and
// drifts.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "lib/scene/quantity.h"
#include "lib/simulation/run/setup.h"
#include "lib/study/compare/measurement_result.h"

namespace orthodyn::study::compare {

// The states of a reference, in its folder.
inline constexpr const char* kTrajectoryFile = "trajectory.bin";

// The quantities of a comparison in one of its scenes. Throws ConfigError at `origin` for what the scene does not have.
std::vector<Quantity> followed_quantities(const Setup& setup, const std::vector<std::string>& names,
                                          const SourceLocation& origin);

// Trajectories that are to be kept go to `folder`. A run that fails is a result. Throws RunError if a reference cannot
// be read or a trajectory not be written.
MeasurementResult measure(Setup setup, const MeasurementInput& input, const std::filesystem::path& folder);

// Does the job of a folder; all `ranks` that compute it together call this, null for this process alone. Throws as
// serve_job() does.
void measure(const std::filesystem::path& folder, const Ranks* ranks);

}  // namespace orthodyn::study::compare
