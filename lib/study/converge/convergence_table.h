// What came out of a refinement, as JSON: values, limits, errors, orders, costs.
#pragma once

#include <filesystem>
#include <map>
#include <vector>

#include "lib/study/converge/convergence.h"
#include "lib/study/jobs/job.h"
#include "lib/study/points/evaluation.h"

namespace orthodyn::study::converge {

using Results = std::map<std::filesystem::path, EvaluationResult>;  // by the folder of a job

// `jobs` by level. Errors are relative to the limit of each metric.
Json convergence_json(const Convergence& wanted, const Design& design, const std::vector<Job>& jobs,
                      const Results& results);

}  // namespace orthodyn::study::converge
