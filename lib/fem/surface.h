// A surface of a mesh at rest, and its share of each node.
#pragma once

#include <utility>
#include <vector>

#include "lib/core/types.h"
#include "lib/mesh/tet_mesh.h"

namespace orthodyn {

using NodalForces = std::vector<std::pair<int, Vec3>>;  // node, N

double surface_area(const TetMesh& mesh, const std::vector<Triangle>& triangles);  // m^2

// A traction (Pa, per undeformed area) on a surface: F_i = integral of N_i t dA, for nodes in ascending order.
NodalForces surface_forces(const TetMesh& mesh, const std::vector<Triangle>& triangles, const Vec3& traction);

}  // namespace orthodyn
