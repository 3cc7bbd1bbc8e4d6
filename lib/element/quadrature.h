// Quadrature points and weights: tetrahedra and triangles in barycentric coordinates, lines, squares, cubes and wedges
// in natural coordinates.
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

// Exact for polynomials of degree 2: three points inside the triangle, one near each corner (Hammer & Stroud 1956).
const std::vector<TrianglePoint>& triangle_points_of_degree_2();

// Exact for polynomials of degree 4, with six points (Strang & Fix 1973, Table 4.1; closed form: Lyness & Jespersen
// 1975).
const std::vector<TrianglePoint>& triangle_points_of_degree_4();

// Exact for polynomials of degree 5 (Radon 1948, Zur mechanischen Kubatur).
const std::array<TrianglePoint, 7>& triangle_points_of_degree_5();

struct LinePoint {
  double x, weight;  // on [-1, 1]; sum of weights 2
};

// Gauss-Legendre rules of two and three points, exact for polynomials of degree 3 and 5 (Abramowitz & Stegun 25.4.30).
const std::vector<LinePoint>& line_points_of_degree_3();
const std::vector<LinePoint>& line_points_of_degree_5();

struct QuadraturePoint {
  Vec3 place;  // natural coordinates of a cell or face
  double weight;
};

// Replaces the kPoints points of an element. The points cover a part of the cell: all of it or one ply.
struct IntegrationRule {
  std::vector<QuadraturePoint> points;
  Eigen::Matrix3Xd nodes;    // nodes of the part, in natural coordinates and node order of the cell
  Eigen::MatrixXd to_nodes;  // nodes x points: extrapolates values at the points to `nodes`
};

// The matrix (nodes x points) that extrapolates values at integration points to the nodes. `at_nodes`, `at_points`:
// values of as many polynomials as there are points, one row per node or point, one column per polynomial.
Eigen::MatrixXd extrapolation_matrix(const Eigen::MatrixXd& at_nodes, const Eigen::MatrixXd& at_points);

// Points (x, y, 0) of [-1, 1]^2, exact for polynomials of degree 5 in each coordinate. Sum of weights 4.
const std::array<QuadraturePoint, 9>& square_points_of_degree_5();

// Product rules. cube_points(): on [-1, 1]^3, x varying fastest; sum of weights 8. wedge_points(): on the wedge (r, s,
// t), barycentric coordinates (1 - r - s, r, s) and t in [-1, 1], t varying slowest; sum of weights 1.
std::vector<QuadraturePoint> cube_points(const std::vector<LinePoint>& line);
std::vector<QuadraturePoint> wedge_points(const std::vector<TrianglePoint>& triangle,
                                          const std::vector<LinePoint>& line);

// On [-1, 1]^3, exact for polynomials of degree 5 (Irons 1971): one point on the axis to each face, in the order -x, x,
// -y, ..., then one on the diagonal to each corner, x varying fastest. Sum of weights 8.
std::vector<QuadraturePoint> irons_points();

}  // namespace orthodyn
