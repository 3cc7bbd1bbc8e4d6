// Checks the number of linear elements through the thickness of a region: with one to three of them, bending is far too
// stiff (docs/accuracy.md).
#pragma once

#include <string>
#include <vector>

#include "lib/fem/fem_model.h"

namespace orthodyn {

// One sentence for each deformable region that is one to three linear elements thick; empty for quadratic elements. A
// region is one element thick if all its nodes are on its surface, and two or three if all nodes are at most one edge
// away from the surface.
std::vector<std::string> thin_regions(const FemModel::Parts& parts);

}  // namespace orthodyn
