// JSON with its keys in the order in which they were put in, and what a run has cost as JSON.
#pragma once

#include <nlohmann/json.hpp>

#include "lib/ode/statistics.h"

namespace orthodyn {

using Json = nlohmann::ordered_json;

Json to_json(const Statistics& statistics);
Statistics statistics_from(const Json& json);

}  // namespace orthodyn
