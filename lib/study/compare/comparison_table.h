// The results of a comparison as JSON for the report, and as CSV with one row per point.
#pragma once

#include <string>

#include "lib/study/compare/comparison_run.h"

namespace orthodyn::study::compare {

// The error on which answers and orders are based: the root mean square over time of the displacement's error, in the
// mass norm or, across meshes, at the probes.
inline constexpr const char* kLeadingError = "displacement.l2";

// The document described in docs/compare.md. `file`: path of the comparison's file, shown in the report.
Json comparison_json(const ComparisonRun& run, const std::string& file);

// The Pareto fronts (error, CPU time) of a comparison across meshes, one per group; empty for any other comparison. A
// front lists its points as indices into `points` of `document`. For each error of targets() (work_precision.h) it
// names the fastest point that reaches the error, as data and in words. `document` must have problems, methods and
// points.
Json pareto_fronts_json(const ComparisonRun& run, const Json& document);

// CSV of the document's points: a header with units, then one row per point.
std::string comparison_csv(const Json& comparison);

}  // namespace orthodyn::study::compare
