// The table of a refinement (convergence_table.h) as CSV, and for people.
#pragma once

#include <string>

#include "lib/simulation/output/json.h"

namespace orthodyn::study::converge {

std::string convergence_csv(const Json& table);

// A table of each metric, and what an error of one per cent costs.
std::string convergence_text(const Json& table);

}  // namespace orthodyn::study::converge
