// The wedge of 15 nodes: corners 0 to 5, then the middles of the edges of both triangles and of the edges between them
// (lib/core/cell_shape.h). Natural coordinates (r, s, t): L = (1 - r - s, r, s) are the barycentric coordinates in the
// triangles, t = -1 on triangle 0 1 2 and t = 1 on triangle 3 4 5. Shape functions (Zienkiewicz & Taylor 2000, vol. 1,
// ch. 8), with those of the quadratic triangle, T_i:
//
//   N = L_i (1 - t^2) between the triangles,  N = T_i (1 -+ t)/2 - L_i (1 - t^2)/2 at corners,
//   N = T_i (1 -+ t)/2 on the edges of the triangles.
//
// Stiffness: three points in the triangle times three along t, as in the element C3D15 of Abaqus; reduced across the
// triangle, but of full rank. Mass: six points in the triangle times three along t, exact for an affine cell. Lumped
// mass: the diagonal of the consistent mass, scaled to the total mass (Hinton, Rock & Zienkiewicz 1976), because the
// row sums of the corners are negative.
#pragma once

#include "lib/element/isoparametric.h"
#include "lib/element/tri3.h"
#include "lib/element/tri6.h"

namespace orthodyn {

inline Vec3 wedge_barycentric(const Vec3& xi) { return {1 - xi[0] - xi[1], xi[0], xi[1]}; }

// Corners of the reference wedge, one per column.
inline Eigen::Matrix<double, 3, 6> wedge_corners() {
  Eigen::Matrix<double, 3, 6> all;
  all << 0, 1, 0, 0, 1, 0,  //
      0, 0, 1, 0, 0, 1,     //
      -1, -1, -1, 1, 1, 1;
  return all;
}

struct ReferenceWedge15 {
  static constexpr CellShape kShape = CellShape::wedge15;
  static constexpr int kNodes = 15, kPoints = 9;

  static const ElementNodes<kNodes>& nodes() {
    static const ElementNodes<kNodes> all = nodes_from_corners<kNodes>(kShape, wedge_corners());
    return all;
  }
  static const std::vector<QuadraturePoint>& points() {
    static const std::vector<QuadraturePoint> all =
        wedge_points(triangle_points_of_degree_2(), line_points_of_degree_5());
    return all;
  }
  static const std::vector<QuadraturePoint>& mass_points() {
    static const std::vector<QuadraturePoint> all =
        wedge_points(triangle_points_of_degree_4(), line_points_of_degree_5());
    return all;
  }

  static Eigen::Matrix<double, kNodes, 1> shape(const Vec3& xi) {
    const Vec3 L = wedge_barycentric(xi);
    return product(Tri6::shape(L), L, along(xi[2]));
  }
  static Eigen::Matrix<double, kNodes, 3> shape_slopes(const Vec3& xi) {
    const Vec3 L = wedge_barycentric(xi), f = along(xi[2]);
    const Eigen::Matrix<double, 6, 2> T = Tri6::slopes(L);
    const Eigen::Matrix<double, 3, 2> L_slopes = Tri3::slopes(L);
    Eigen::Matrix<double, kNodes, 3> slopes;
    slopes << product(T.col(0), L_slopes.col(0), f), product(T.col(1), L_slopes.col(1), f),
        product(Tri6::shape(L), L, Vec3(-0.5, 0.5, -2 * xi[2]));
    return slopes;
  }

  // Linear in the triangle, quadratic along t.
  static Eigen::Matrix<double, kPoints, 1> interpolation(const Vec3& xi) {
    const Vec3 L = wedge_barycentric(xi);
    Eigen::Matrix<double, kPoints, 1> P;
    P << L, L * xi[2], L * xi[2] * xi[2];
    return P;
  }

 private:
  static Vec3 along(double t) { return {(1 - t) / 2, (1 + t) / 2, 1 - t * t}; }

  // The shape functions or a derivative of them, from T, L and f = along(t) or from the derivative of one of these.
  static Eigen::Matrix<double, kNodes, 1> product(const Eigen::Matrix<double, 6, 1>& T, const Vec3& L, const Vec3& f) {
    Eigen::Matrix<double, kNodes, 1> N;
    N << T.head<3>() * f[0] - L * f[2] / 2, T.head<3>() * f[1] - L * f[2] / 2, T.tail<3>() * f[0], T.tail<3>() * f[1],
        L * f[2];
    return N;
  }
};

struct Wedge15 : Isoparametric<ReferenceWedge15> {
  static constexpr int kDegree = 2;
  // The integrals of N_a^2 over an affine cell of volume 1 are 3/135, 8/135 and 12/135.
  static constexpr double kCorner = 3.0 / 102, kTriangleEdge = 8.0 / 102, kLongEdge = 12.0 / 102;
  static constexpr std::array<double, kNodes> kLumpedShares{
      kCorner,       kCorner,       kCorner,       kCorner,       kCorner,   kCorner,   kTriangleEdge, kTriangleEdge,
      kTriangleEdge, kTriangleEdge, kTriangleEdge, kTriangleEdge, kLongEdge, kLongEdge, kLongEdge};
  // 8.622, of an affine cell: the larger root r of 289 r^2 - 2805 r + 2700 = 0.
  static constexpr double kLumpedToConsistent = 15 * (11 + 8.544003745317532) / 34;  // sqrt(73)
  static constexpr int kPressures = 1;
};

static_assert(Element<Wedge15>);

}  // namespace orthodyn
