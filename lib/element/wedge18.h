// The wedge of 18 nodes: those of Wedge15, then the middles of the quadrilaterals (lib/core/cell_shape.h). Shape
// functions: products of those of the quadratic triangle and of the quadratic line, in the natural coordinates (r, s,
// t) of wedge15.h.
//
// Stiffness and mass: six points in the triangle times three along t. The mass is exact for an affine cell, the volume
// also for curved edges, and the stiffness has full rank.
#pragma once

#include "lib/element/cube_functions.h"
#include "lib/element/wedge15.h"

namespace orthodyn {

struct ReferenceWedge18 {
  static constexpr CellShape kShape = CellShape::wedge18;
  static constexpr int kNodes = 18, kPoints = 18;

  static const ElementNodes<kNodes>& nodes() {
    static const ElementNodes<kNodes> all = nodes_from_corners<kNodes>(kShape, wedge_corners());
    return all;
  }
  static const std::vector<QuadraturePoint>& points() { return ReferenceWedge15::mass_points(); }
  static const std::vector<QuadraturePoint>& mass_points() { return points(); }

  static Eigen::Matrix<double, kNodes, 1> shape(const Vec3& xi) {
    return product(Tri6::shape(wedge_barycentric(xi)), along<line_lagrange>(xi[2]));
  }
  static Eigen::Matrix<double, kNodes, 3> shape_slopes(const Vec3& xi) {
    const Vec3 L = wedge_barycentric(xi), f = along<line_lagrange>(xi[2]);
    const Eigen::Matrix<double, 6, 2> T = Tri6::slopes(L);
    Eigen::Matrix<double, kNodes, 3> slopes;
    slopes << product(T.col(0), f), product(T.col(1), f), product(Tri6::shape(L), along<line_lagrange_slope>(xi[2]));
    return slopes;
  }

  // Quadratic in the triangle and along t.
  static Eigen::Matrix<double, kPoints, 1> interpolation(const Vec3& xi) { return shape(xi); }

 private:
  // Values on triangle 0 1 2, on triangle 3 4 5 and in the middle.
  template <double (*kFunction)(double, double)>
  static Vec3 along(double t) {
    return {kFunction(-1, t), kFunction(1, t), kFunction(0, t)};
  }

  static Eigen::Matrix<double, kNodes, 1> product(const Eigen::Matrix<double, 6, 1>& T, const Vec3& f) {
    Eigen::Matrix<double, kNodes, 1> N;
    const Vec3 corners = T.head<3>(), middles = T.tail<3>();
    N << corners * f[0], corners * f[1], middles * f[0], middles * f[1], corners * f[2], middles * f[2];
    return N;
  }
};

struct Wedge18 : Isoparametric<ReferenceWedge18> {
  static constexpr int kDegree = 2;
  // Products of 3/57, 16/57 of the triangle (tri6.h) and 1/6, 4/6, 1/6 of the line (hex27.h).
  static constexpr double kCorner = 3.0 / 342, kTriangleEdge = 16.0 / 342, kLongEdge = 12.0 / 342, kSide = 64.0 / 342;
  static constexpr std::array<double, kNodes> kLumpedShares{
      kCorner,       kCorner,       kCorner,       kCorner,       kCorner,       kCorner,
      kTriangleEdge, kTriangleEdge, kTriangleEdge, kTriangleEdge, kTriangleEdge, kTriangleEdge,
      kLongEdge,     kLongEdge,     kLongEdge,     kSide,         kSide,         kSide};
  // 10.06, of an affine cell: 5/2 of the line times the ratio r of the triangle, 361 r^2 - 1900 r + 1800 = 0.
  static constexpr double kLumpedToConsistent = 2.5 * 10 * (5 + 2.6457513110645907) / 19;  // sqrt(7)
  static constexpr int kPressures = 1;
};

static_assert(Element<Wedge18>);

}  // namespace orthodyn
