// The hexahedron of 8 nodes, with trilinear shape functions: corners 0 to 7 (lib/core/cell_shape.h). Natural
// coordinates in [-1, 1]^3.
//
// Stiffness and mass: 2 x 2 x 2 Gauss points, exact for a parallelepiped; the volume is exact for every cell. The
// stiffness has full rank. In bending, parasitic shear adds a stiffness that grows with (length / thickness)^2 of a
// cell. Its mixed formulation, with one pressure per element, is the B-bar element of Hughes (1980).
#pragma once

#include "lib/element/cube_functions.h"
#include "lib/element/isoparametric.h"

namespace orthodyn {

struct ReferenceHex8 {
  static constexpr CellShape kShape = CellShape::hex8;
  static constexpr int kNodes = 8, kPoints = 8;

  static const ElementNodes<kNodes>& nodes() {
    static const ElementNodes<kNodes> all = cube_corners();
    return all;
  }
  static const std::vector<QuadraturePoint>& points() {
    static const std::vector<QuadraturePoint> all = cube_points(line_points_of_degree_3());
    return all;
  }
  static const std::vector<QuadraturePoint>& mass_points() { return points(); }

  static Eigen::Matrix<double, kNodes, 1> shape(const Vec3& xi) {
    Eigen::Matrix<double, kNodes, 1> N;
    for (int a = 0; a < kNodes; ++a) N[a] = multilinear<3>(nodes().col(a), xi).value;
    return N;
  }
  static Eigen::Matrix<double, kNodes, 3> shape_slopes(const Vec3& xi) {
    Eigen::Matrix<double, kNodes, 3> slopes;
    for (int a = 0; a < kNodes; ++a) slopes.row(a) = multilinear<3>(nodes().col(a), xi).slopes;
    return slopes;
  }

  // Trilinear.
  static Eigen::Matrix<double, kPoints, 1> interpolation(const Vec3& xi) { return shape(xi); }
};

struct Hex8 : Isoparametric<ReferenceHex8> {
  static constexpr int kDegree = 1;
  static constexpr std::array<double, kNodes> kLumpedShares{0.125, 0.125, 0.125, 0.125, 0.125, 0.125, 0.125, 0.125};
  static constexpr double kLumpedToConsistent = 27;  // of a parallelepiped: 3 in each direction
  static constexpr int kPressures = 1;
};

static_assert(Element<Hex8>);

}  // namespace orthodyn
