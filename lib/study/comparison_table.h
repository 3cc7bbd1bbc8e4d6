// A comparison's results as data for others: one JSON document for the report, one CSV row a point.
#pragma once

#include <filesystem>
#include <string>

#include "lib/study/campaign.h"

namespace orthodyn {

// The document; its fields are described in docs/compare.md. `file` is the comparison's, for the reader.
Json comparison_json(const Campaign& campaign, const std::string& file, const std::string& started);

// The same points, tidy: a header with units, then a row a point.
std::string comparison_csv(const Json& comparison);

}  // namespace orthodyn
