// Warnings of `orthodyn sweep` on stderr.
#pragma once

#include <vector>

#include "lib/simulation/output/json.h"
#include "lib/study/sweep/sweep_design.h"

namespace orthodyn::study::sweep {

// Warns of points with an invalid scene: names the first, with its error, and the number of the others.
void warn_of_impossible_points(const std::vector<Point>& points);

// Warns of coarse meshes and coarse frequencies, and prints warnings of finished points. Warnings of the same kind as
// one of the first point are left out, because they were printed before the run. `table`: from sweep_json().
void warn_of_finished_points(const Json& table);

}  // namespace orthodyn::study::sweep
