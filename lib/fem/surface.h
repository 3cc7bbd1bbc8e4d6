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

// The same of components that may depend on the position at rest: exact for polynomials of degree 4 on the plane
// faces of linear tetrahedra, of degree 3 on those of quadratic ones.
NodalForces surface_forces(const TetMesh& mesh, const std::vector<Triangle>& triangles,
                           const std::array<PointQuantity, 3>& traction);

// Each node's share of a surface where something acts on nodes alone, as contact does: positive, m^2.
std::vector<std::pair<int, double>> node_areas(const TetMesh& mesh, const std::vector<Triangle>& triangles);

}  // namespace orthodyn
