// Finds straight rows of hexahedra, one cell wide and one cell high.
#pragma once

#include <vector>

#include "lib/mesh/mesh.h"

namespace orthodyn {

// For each cell: 1 for a hexahedron of 20 nodes without neighbours in at least two of its three directions, else 0.
std::vector<char> cells_in_rows(const Mesh& mesh);

}  // namespace orthodyn
