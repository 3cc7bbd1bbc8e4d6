// The jobs of a sweep, and their results: as JSON for the report, and as CSV with one row per point.
#pragma once

#include <cstddef>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "lib/study/points/evaluation.h"
#include "lib/study/points/point_jobs.h"
#include "lib/study/sweep/sweep_design.h"

namespace orthodyn::study::sweep {

// One job per point; empty for an impossible point. Job folders are in `folder`/points; points with equal scenes share
// a folder. `ranks`: MPI ranks per point. Throws RunError if a file of a scene cannot be read.
std::vector<std::optional<Job>> jobs_of(const Sweep& sweep, const std::vector<Point>& points,
                                        const std::filesystem::path& folder, int ranks);

// The jobs, with one job per folder.
std::vector<Job> distinct(const std::vector<std::optional<Job>>& jobs);

// The jobs of part `part`, from 1 to `parts`. Each part takes every `parts`-th job, so that neighbouring jobs, which
// cost about the same, go to different parts.
std::vector<Job> slice(const std::vector<Job>& jobs, std::size_t part, std::size_t parts);

// Status of a point without a result, and reason of a point with an invalid scene.
inline constexpr const char* kMissing = "missing";
inline constexpr const char* kImpossible = "impossible";

// Results by job folder.
using Results = std::map<std::filesystem::path, EvaluationResult>;

// Results on disk, including those of processes that died.
Results results_of(const std::vector<Job>& jobs);

// `jobs`: from jobs_of(). `file`: path of the sweep's file. `ranks`: MPI ranks per point.
Json sweep_json(const Sweep& sweep, const std::vector<Point>& points, const std::vector<std::optional<Job>>& jobs,
                const Results& results, const std::string& file, int ranks);

// `table`: from sweep_json().
std::string sweep_csv(const Json& table);

}  // namespace orthodyn::study::sweep
