// Results of a convergence study as JSON, CSV and text: values, extrapolated limits, errors, observed orders, costs.
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "lib/study/converge/convergence.h"
#include "lib/study/jobs/job.h"
#include "lib/study/points/evaluation.h"

namespace orthodyn::study::converge {

using Results = std::map<std::filesystem::path, EvaluationResult>;  // by job folder

// `jobs`: one per entry of design.levels. Errors are relative to the limit of each metric.
Json convergence_json(const Convergence& wanted, const Design& design, const std::vector<Job>& jobs,
                      const Results& results);

std::string convergence_csv(const Json& table);

// The answer of each metric, then for each metric a table and the cost of an error of one per cent.
std::string convergence_text(const Json& table);

// A metric's value on the finest mesh where it is known.
struct FinestMesh {
  double value = 0, mesh_error = 0;  // mesh_error: estimated, relative; NaN if unknown
  int order = 1;                     // of the elements
};

// "linear" or "quadratic"
const char* words_of_order(int order);

// Sentence with the limit of a metric, its uncertainty and the CPU time for the relative error `target`. Without a
// limit: the reason, and the value on the finest mesh. `metric`: an entry of `metrics` in the JSON document.
std::string answer(const Json& metric, const std::optional<FinestMesh>& finest, double target);

}  // namespace orthodyn::study::converge
