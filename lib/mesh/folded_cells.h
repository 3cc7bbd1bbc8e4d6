// Folded cells: the Jacobian of the map from the reference cell changes its sign within the cell.
#pragma once

#include "lib/mesh/mesh.h"

namespace orthodyn {

// Throws ConfigError at a cell whose Jacobian is not positive at each node and each integration point. Precondition: no
// cell is inverted as a whole.
void check_folding(const Mesh& mesh, const MeshOrigin& origin);

}  // namespace orthodyn
