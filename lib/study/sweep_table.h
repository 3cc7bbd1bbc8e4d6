// All that a sweep has found, as JSON for the report and as a table with a row a point.
#pragma once

#include "lib/study/errand.h"
#include "lib/study/sweep_design.h"

namespace orthodyn {

// Results are looked up on the disk; a point without one is "missing". `file` is the sweep's.
Json sweep_json(const Sweep& sweep, const std::vector<SweepPoint>& points, const std::vector<Errand>& errands,
                const std::string& file);

// Of sweep_json().
std::string sweep_csv(const Json& table);

}  // namespace orthodyn
