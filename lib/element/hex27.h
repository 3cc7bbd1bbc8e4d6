// The hexahedron of 27 nodes, with triquadratic shape functions: corners 0 to 7, then the middles of the edges, of the
// faces, and of the cell (lib/core/cell_shape.h). Natural coordinates in [-1, 1]^3.
//
// Stiffness and mass: 3 x 3 x 3 Gauss points, exact for a parallelepiped; the volume is exact also for curved edges.
// The stiffness has full rank.
#pragma once

#include "lib/element/cube_functions.h"
#include "lib/element/isoparametric.h"

namespace orthodyn {

struct ReferenceHex27 {
  static constexpr CellShape kShape = CellShape::hex27;
  static constexpr int kNodes = 27, kPoints = 27;

  static const ElementNodes<kNodes>& nodes() {
    static const ElementNodes<kNodes> all = nodes_from_corners<kNodes>(kShape, cube_corners());
    return all;
  }
  static const std::vector<QuadraturePoint>& points() {
    static const std::vector<QuadraturePoint> all = cube_points(line_points_of_degree_5());
    return all;
  }
  static const std::vector<QuadraturePoint>& mass_points() { return points(); }

  static Eigen::Matrix<double, kNodes, 1> shape(const Vec3& xi) {
    Eigen::Matrix<double, kNodes, 1> N;
    for (int a = 0; a < kNodes; ++a) N[a] = lagrange<3>(nodes().col(a), xi).value;
    return N;
  }
  static Eigen::Matrix<double, kNodes, 3> shape_slopes(const Vec3& xi) {
    Eigen::Matrix<double, kNodes, 3> slopes;
    for (int a = 0; a < kNodes; ++a) slopes.row(a) = lagrange<3>(nodes().col(a), xi).slopes;
    return slopes;
  }

  // Triquadratic.
  static Eigen::Matrix<double, kPoints, 1> interpolation(const Vec3& xi) { return shape(xi); }
};

struct Hex27 : Isoparametric<ReferenceHex27> {
  static constexpr int kDegree = 2;
  // Products of 1/6, 4/6, 1/6, which are both the scaled diagonal and the row sums of the mass of a line of three
  // nodes, [4 2 -1; 2 16 2; -1 2 4]/30 in the order end, middle, end.
  static constexpr double kCorner = 1.0 / 216, kEdge = 4.0 / 216, kSide = 16.0 / 216, kCentre = 64.0 / 216;
  static constexpr std::array<double, kNodes> kLumpedShares{
      kCorner, kCorner, kCorner, kCorner, kCorner, kCorner, kCorner, kCorner, kEdge, kEdge, kEdge, kEdge, kEdge,  kEdge,
      kEdge,   kEdge,   kEdge,   kEdge,   kEdge,   kEdge,   kSide,   kSide,   kSide, kSide, kSide, kSide, kCentre};
  static constexpr double kLumpedToConsistent = 125.0 / 8;  // of a parallelepiped: 5/2 in each direction
  static constexpr int kPressures = 4;
};

static_assert(Element<Hex27>);

}  // namespace orthodyn
