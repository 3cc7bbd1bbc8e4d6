// The work of a sweep: a job for each point.
#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <vector>

#include "lib/study/points/point_jobs.h"
#include "lib/study/sweep/sweep_design.h"

namespace orthodyn::study::sweep {

// By point; nothing of an impossible one. In FOLDER/points; points with the same scene share a folder. Throws RunError
// if a file of a scene cannot be read. `ranks`: that compute each point.
std::vector<std::optional<Job>> jobs_of(const Sweep& sweep, const std::vector<Point>& points,
                                        const std::filesystem::path& folder, int ranks);

// One job of each folder.
std::vector<Job> distinct(const std::vector<std::optional<Job>>& jobs);

// The I-th of N interleaved parts, 1 <= I <= N: neighbours, which cost alike, go to different parts.
std::vector<Job> slice(const std::vector<Job>& jobs, std::size_t part, std::size_t parts);

}  // namespace orthodyn::study::sweep
