// A comparison's results as data for others: one JSON document for the report, one CSV row a point.
#pragma once

#include <string>

#include "lib/study/compare/campaign.h"

namespace orthodyn {

// What answers and orders are about: rms over time of the displacement in the mass norm.
inline constexpr const char* kLeadingError = "displacement.l2";

// The document; its fields are described in docs/compare.md. `file` is the comparison's, for the reader.
Json comparison_json(const Campaign& campaign, const std::string& file);

// True if an error of a point ("displacement.l2") cannot be told from the reference's own.
bool is_near_reference(const Json& point, const std::string& error);

// The same points, tidy: a header with units, then a row a point.
std::string comparison_csv(const Json& comparison);

}  // namespace orthodyn
