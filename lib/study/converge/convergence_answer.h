// What a refinement says of one metric, in a sentence.
#pragma once

#include <optional>
#include <string>

#include "lib/simulation/output/json.h"

namespace orthodyn::study::converge {

struct FinestMesh {
  double value = 0, mesh_error = 0;  // estimated, a share; NaN where there is none
  int order = 1;                     // of its elements
};

// "quadratic"
const char* words_of_order(int order);

// Of a metric of the table (convergence_table.h); `target`: the error whose cost is told.
std::string answer(const Json& metric, const std::optional<FinestMesh>& finest, double target);

}  // namespace orthodyn::study::converge
