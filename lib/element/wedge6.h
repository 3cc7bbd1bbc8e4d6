// The wedge of 6 nodes: corners 0 to 5 (lib/core/cell_shape.h). Shape functions: products of those of the linear
// triangle and of the linear line, in the natural coordinates (r, s, t) of wedge15.h.
//
// Stiffness and mass: three points in the triangle times two along t. The mass is exact for an affine cell, the volume
// for every cell, and the stiffness has full rank. Like Hex8 it is stiff in bending, and its mixed formulation has one
// pressure per element.
#pragma once

#include "lib/element/wedge15.h"

namespace orthodyn {

struct ReferenceWedge6 {
  static constexpr CellShape kShape = CellShape::wedge6;
  static constexpr int kNodes = 6, kPoints = 6;

  static const ElementNodes<kNodes>& nodes() {
    static const ElementNodes<kNodes> all = wedge_corners();
    return all;
  }
  static const std::vector<QuadraturePoint>& points() {
    static const std::vector<QuadraturePoint> all =
        wedge_points(triangle_points_of_degree_2(), line_points_of_degree_3());
    return all;
  }
  static const std::vector<QuadraturePoint>& mass_points() { return points(); }

  static Eigen::Matrix<double, kNodes, 1> shape(const Vec3& xi) {
    const Vec3 L = wedge_barycentric(xi);
    Eigen::Matrix<double, kNodes, 1> N;
    N << L * (1 - xi[2]) / 2, L * (1 + xi[2]) / 2;
    return N;
  }
  static Eigen::Matrix<double, kNodes, 3> shape_slopes(const Vec3& xi) {
    const Vec3 L = wedge_barycentric(xi);
    const Eigen::Matrix<double, 3, 2> L_slopes = Tri3::slopes(L);
    Eigen::Matrix<double, kNodes, 3> slopes;
    slopes << L_slopes * (1 - xi[2]) / 2, -L / 2, L_slopes * (1 + xi[2]) / 2, L / 2;
    return slopes;
  }

  // Linear in the triangle and along t.
  static Eigen::Matrix<double, kPoints, 1> interpolation(const Vec3& xi) { return shape(xi); }
};

struct Wedge6 : Isoparametric<ReferenceWedge6> {
  static constexpr int kDegree = 1;
  static constexpr std::array<double, kNodes> kLumpedShares{1.0 / 6, 1.0 / 6, 1.0 / 6, 1.0 / 6, 1.0 / 6, 1.0 / 6};
  static constexpr double kLumpedToConsistent = 12;  // of an affine cell: 4 in the triangle times 3 along t
  static constexpr int kPressures = 1;
};

static_assert(Element<Wedge6>);

}  // namespace orthodyn
