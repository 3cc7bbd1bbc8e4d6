// A surface of a mesh as its nodes share it: a third of each triangle, at rest.
#pragma once

#include <utility>
#include <vector>

#include "lib/core/types.h"
#include "lib/mesh/tet_mesh.h"

namespace orthodyn {

using NodalForces = std::vector<std::pair<int, Vec3>>;  // node, N

double surface_area(const TetMesh& mesh, const std::vector<Triangle>& triangles);  // m^2

// A traction (Pa, per undeformed area) on a surface: F_i = integral of N_i t dA.
NodalForces surface_forces(const TetMesh& mesh, const std::vector<Triangle>& triangles, const Vec3& traction);

}  // namespace orthodyn
