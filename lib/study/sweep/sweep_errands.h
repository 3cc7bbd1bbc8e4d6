// The work of a sweep: an errand for each point, in a folder whose name tells what the result depends on: the scene,
// the files that it names, the figures, the limits, the program. Not the machine: points may come from several.
#pragma once

#include <filesystem>
#include <vector>

#include "lib/study/jobs/errand.h"
#include "lib/study/sweep/sweep_design.h"

namespace orthodyn {

// By point, in FOLDER/points; of an impossible point the errand has no command. Points with the same scene share one.
// Throws RunError if a file of a scene cannot be read.
std::vector<Errand> errands_of(const Sweep& sweep, const std::vector<SweepPoint>& points,
                               const std::filesystem::path& folder);

// Of those that there is something to do for, each once.
std::vector<Errand> distinct(const std::vector<Errand>& errands);

// The I-th of N interleaved parts, 1 <= I <= N: neighbours, which cost alike, go to different parts.
std::vector<Errand> slice(const std::vector<Errand>& errands, std::size_t part, std::size_t parts);

}  // namespace orthodyn
