// Integrals over a surface of the undeformed mesh.
#pragma once

#include <array>
#include <utility>
#include <vector>

#include "lib/config/formula.h"
#include "lib/core/types.h"
#include "lib/mesh/mesh.h"

namespace orthodyn {

using NodalForces = std::vector<std::pair<int, Vec3>>;  // node, N

double surface_area(const Mesh& mesh, const std::vector<FaceCorners>& faces);  // m^2

// Nodal forces of a traction t (Pa, per undeformed area): F_i = integral of N_i t dA, with shape functions N_i. Nodes
// are in ascending order.
NodalForces surface_forces(const Mesh& mesh, const std::vector<FaceCorners>& faces, const Vec3& traction);

// Likewise for a traction that depends on the rest position. Exact for polynomials of degree 4 on faces of linear
// tetrahedra, and of degree 3 on plane faces of quadratic tetrahedra.
NodalForces surface_forces(const Mesh& mesh, const std::vector<FaceCorners>& faces,
                           const std::array<PointQuantity, 3>& traction);

double largest_area(const std::vector<std::pair<int, double>>& areas);  // m^2; 0 of none

}  // namespace orthodyn
