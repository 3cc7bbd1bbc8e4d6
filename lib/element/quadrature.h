// Quadrature points and weights for tetrahedra and triangles, in barycentric coordinates.
#pragma once

#include <array>
#include <vector>

#include "lib/core/types.h"

namespace orthodyn {

struct TetrahedronPoint {
  Eigen::Vector4d L;
  double weight;  // sum 1/6, the volume of the unit tetrahedron
};

// Exact for polynomials of degree 7: the product of Gauss-Legendre rules of five points in collapsed coordinates r, s,
// t in [0, 1],
//   L_1 = r, L_2 = (1 - r) s, L_3 = (1 - r)(1 - s) t,  dL_1 dL_2 dL_3 = (1 - r)^2 (1 - s) dr ds dt.
const std::vector<TetrahedronPoint>& tetrahedron_points_of_degree_7();

struct TrianglePoint {
  Vec3 L;
  double weight;  // share of the area; sum 1
};

// Exact for polynomials of degree 5 (Radon 1948, Zur mechanischen Kubatur).
const std::array<TrianglePoint, 7>& triangle_points_of_degree_5();

}  // namespace orthodyn
