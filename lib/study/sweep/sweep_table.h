// All that a sweep has found, as JSON for the report and as a table with a row a point.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "lib/study/jobs/errand.h"
#include "lib/study/sweep/sweep_design.h"

namespace orthodyn {

// The columns of sweep.csv beside those of variables and figures; those that a figure of this cost has are left out.
inline constexpr std::string_view kTableColumns[] = {"point",       "status", "reason",   "message", "wall_seconds",
                                                     "cpu_seconds", "steps",  "unknowns", "folder"};
// Columns beside that of a figure with a closed form: endings of its name.
inline constexpr const char* kBesideClosedForms[] = {".closed_form", ".relative_difference"};

// By folder of the errand.
using PointResults = std::map<std::filesystem::path, Json>;

// Those that are on the disk, of processes that died as well.
PointResults results_of(const std::vector<Errand>& errands);

// A point that has no result, and can have one, is "missing". `file` is the sweep's.
Json sweep_json(const Sweep& sweep, const std::vector<SweepPoint>& points, const std::vector<Errand>& errands,
                const PointResults& results, const std::string& file);

// Of sweep_json().
std::string sweep_csv(const Json& table);

}  // namespace orthodyn
