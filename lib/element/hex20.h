// The hexahedron of 20 nodes, with serendipity shape functions: corners 0 to 7, then the middles of the edges
// (lib/core/cell_shape.h). Natural coordinates in [-1, 1]^3.
//
// Stiffness: 2 x 2 x 2 Gauss points, the reduced integration of Zienkiewicz, Taylor & Too (1971), which avoids most of
// the element's locking. A free cell has 60 - 6 - 48 = 6 zero-energy modes: motions without strain at the points. 2 x 2
// cells have none together, but a straight row of n > 1 single cells keeps n + 1, and n if one end is clamped: its
// stiffness is singular. Such rows take the 14 points of Irons (1971), with which the stiffness has full rank.
//
// Mass: 3 x 3 x 3 Gauss points, exact for a parallelepiped; the volume is exact also for curved edges. Lumped mass: the
// diagonal of the consistent mass, scaled to the total mass (Hinton, Rock & Zienkiewicz 1976), because the row sums of
// the corners are negative.
#pragma once

#include "lib/element/cube_functions.h"
#include "lib/element/isoparametric.h"

namespace orthodyn {

struct ReferenceHex20 {
  static constexpr CellShape kShape = CellShape::hex20;
  static constexpr int kNodes = 20, kPoints = 8;

  static const ElementNodes<kNodes>& nodes() {
    static const ElementNodes<kNodes> all = nodes_from_corners<kNodes>(kShape, cube_corners());
    return all;
  }
  static const std::vector<QuadraturePoint>& points() {
    static const std::vector<QuadraturePoint> all = cube_points(line_points_of_degree_3());
    return all;
  }
  static const std::vector<QuadraturePoint>& mass_points() {
    static const std::vector<QuadraturePoint> all = cube_points(line_points_of_degree_5());
    return all;
  }

  static Eigen::Matrix<double, kNodes, 1> shape(const Vec3& xi) {
    Eigen::Matrix<double, kNodes, 1> N;
    for (int a = 0; a < kNodes; ++a) N[a] = serendipity<3>(nodes().col(a), xi).value;
    return N;
  }
  static Eigen::Matrix<double, kNodes, 3> shape_slopes(const Vec3& xi) {
    Eigen::Matrix<double, kNodes, 3> slopes;
    for (int a = 0; a < kNodes; ++a) slopes.row(a) = serendipity<3>(nodes().col(a), xi).slopes;
    return slopes;
  }

  // Trilinear.
  static Eigen::Matrix<double, kPoints, 1> interpolation(const Vec3& xi) {
    Eigen::Matrix<double, kPoints, 1> P;
    P << 1, xi[0], xi[1], xi[2], xi[0] * xi[1], xi[1] * xi[2], xi[2] * xi[0], xi.prod();
    return P;
  }
  // For irons_points(): trilinear, with the squares and cubes of the coordinates.
  static Eigen::Matrix<double, 14, 1> interpolation_14(const Vec3& xi) {
    Eigen::Matrix<double, 14, 1> P;
    P << interpolation(xi), xi.cwiseAbs2(), xi.cwiseProduct(xi.cwiseAbs2());
    return P;
  }
};

struct Hex20 : Isoparametric<ReferenceHex20> {
  static constexpr int kDegree = 2;
  // The integrals of N_a^2 over a parallelepiped of volume 1 are 7/270 and 16/270.
  static constexpr double kCorner = 7.0 / 248, kMiddle = 16.0 / 248;
  static constexpr std::array<double, kNodes> kLumpedShares{
      kCorner, kCorner, kCorner, kCorner, kCorner, kCorner, kCorner, kCorner, kMiddle, kMiddle,
      kMiddle, kMiddle, kMiddle, kMiddle, kMiddle, kMiddle, kMiddle, kMiddle, kMiddle, kMiddle};
  // 13.48, of a parallelepiped: the larger root r of 961 r^2 - 16740 r + 51030 = 0.
  static constexpr double kLumpedToConsistent = 27 * (10 + 5.477225575051661) / 31;  // sqrt(30)
  static constexpr int kPressures = 4;
};

static_assert(Element<Hex20>);

}  // namespace orthodyn
