// Straight rows of hexahedra that are one cell wide and high.
#pragma once

#include <vector>

#include "lib/mesh/mesh.h"

namespace orthodyn {

// For each cell, whether it is a hexahedron of 20 nodes without neighbours in two of its three directions.
std::vector<char> cells_in_rows(const Mesh& mesh);

}  // namespace orthodyn
