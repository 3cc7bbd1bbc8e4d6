// A comparison's results as data for others: one JSON document for the report, one CSV row a point.
#pragma once

#include <string>

#include "lib/study/compare/comparison_run.h"

namespace orthodyn::study::compare {

// What answers and orders are about: rms over time of the displacement in the mass norm.
inline constexpr const char* kLeadingError = "displacement.l2";

// The document; its fields are described in docs/compare.md. `file` is the comparison's, for the reader.
Json comparison_json(const ComparisonRun& run, const std::string& file);

// The same points, tidy: a header with units, then a row a point.
std::string comparison_csv(const Json& comparison);

}  // namespace orthodyn::study::compare
