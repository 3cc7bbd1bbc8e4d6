// All that a sweep has found, as JSON for the report and as a table with a row a point.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "lib/study/points/evaluation.h"
#include "lib/study/sweep/sweep_jobs.h"

namespace orthodyn::study::sweep {

// The status of a point that is not done yet, and the reason of one whose scene cannot be.
inline constexpr const char* kMissing = "missing";
inline constexpr const char* kImpossible = "impossible";

// By folder of the job.
using Results = std::map<std::filesystem::path, EvaluationResult>;

// Those that are on the disk, of processes that died as well.
Results results_of(const std::vector<Job>& jobs);

// A point that has no result, and can have one, is "missing". `jobs`: by point; `file`: the sweep's;
// `ranks`: that compute a point.
Json sweep_json(const Sweep& sweep, const std::vector<Point>& points, const std::vector<std::optional<Job>>& jobs,
                const Results& results, const std::string& file, int ranks);

// Of sweep_json().
std::string sweep_csv(const Json& table);

}  // namespace orthodyn::study::sweep
