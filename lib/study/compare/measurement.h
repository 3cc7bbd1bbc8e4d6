// The measurement of one scene: several timed integrations without observers give the cost, then one with observers
// gives errors and drifts.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "lib/scene/quantity.h"
#include "lib/simulation/run/setup.h"
#include "lib/study/compare/measurement_result.h"

namespace orthodyn::study::compare {

// File with the trajectory of a reference, in the reference's folder.
inline constexpr const char* kTrajectoryFile = "trajectory.bin";

// Looks up a comparison's quantities in one of its scenes. Throws ConfigError at `origin` if a quantity is unknown or
// cannot be compared with a reference.
std::vector<Quantity> followed_quantities(const Setup& setup, const std::vector<std::string>& names,
                                          const SourceLocation& origin);

// Measures a scene. If `input` asks for the trajectory, writes it to `folder`. A failed run is a result, not an
// exception. Throws RunError if the reference cannot be read or the trajectory cannot be written.
MeasurementResult measure(Setup setup, const MeasurementInput& input, const std::filesystem::path& folder);

// Does a measurement as a job of a comparison, in its own process: reads the input from `folder` and writes the result
// to it by serve_job(), which explains `ranks` and the exceptions.
void measure(const std::filesystem::path& folder, const Ranks* ranks);

}  // namespace orthodyn::study::compare
