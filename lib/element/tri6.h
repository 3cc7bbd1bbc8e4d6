// The quadratic triangle, the face of a quadratic tetrahedron: corners 0, 1, 2 and a node on each edge 01, 12, 20.
#pragma once

#include "lib/element/face.h"

namespace orthodyn {

struct Tri6 {
  static constexpr int kNodes = 6, kPoints = 7, kTangentPoints = 7;
  static constexpr double kCorner = 1.0 / 20, kEdge = 2.0 / 15;
  static constexpr std::array<double, kNodes> kPointShares{kCorner, kCorner, kCorner, kEdge, kEdge, kEdge};

  static const std::array<QuadraturePoint, kPoints>& points() { return triangular_face_points(); }
  static Eigen::Matrix<double, kNodes, 1> shape(const Vec3& L) {
    Eigen::Matrix<double, kNodes, 1> N;
    N << L[0] * (2 * L[0] - 1), L[1] * (2 * L[1] - 1), L[2] * (2 * L[2] - 1),  //
        4 * L[0] * L[1], 4 * L[1] * L[2], 4 * L[2] * L[0];
    return N;
  }
  static Eigen::Matrix<double, kNodes, 2> slopes(const Vec3& L) {
    Eigen::Matrix<double, kNodes, 3> by_L;
    by_L << 4 * L[0] - 1, 0, 0,  //
        0, 4 * L[1] - 1, 0,      //
        0, 0, 4 * L[2] - 1,      //
        4 * L[1], 4 * L[0], 0,   //
        0, 4 * L[2], 4 * L[1],   //
        4 * L[2], 0, 4 * L[0];
    return by_L.rightCols<2>().colwise() - by_L.col(0);
  }
};

static_assert(Face<Tri6>);

}  // namespace orthodyn
