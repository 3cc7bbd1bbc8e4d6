// A surface of a mesh at rest, and its share of each node.
#pragma once

#include <array>
#include <utility>
#include <vector>

#include "lib/config/point_quantity.h"
#include "lib/core/types.h"
#include "lib/mesh/tet_mesh.h"

namespace orthodyn {

using NodalForces = std::vector<std::pair<int, Vec3>>;  // node, N

double surface_area(const TetMesh& mesh, const std::vector<Triangle>& triangles);  // m^2

// A traction (Pa, per undeformed area) on a surface: F_i = integral of N_i t dA, for nodes in ascending order.
NodalForces surface_forces(const TetMesh& mesh, const std::vector<Triangle>& triangles, const Vec3& traction);

// The same of components that may depend on the position at rest: exact for polynomials of degree 4.
NodalForces surface_forces(const TetMesh& mesh, const std::vector<Triangle>& triangles,
                           const std::array<PointQuantity, 3>& traction);

// The means over the triangle of N_i g, for each of its nodes.
Vec3 node_means(const TetMesh& mesh, const Triangle& triangle, const PointQuantity& g);

}  // namespace orthodyn
