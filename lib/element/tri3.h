// The linear triangle, the face of a linear tetrahedron.
#pragma once

#include "lib/element/face.h"

namespace orthodyn {

struct Tri3 {
  static constexpr int kNodes = 3, kPoints = 7, kTangentPoints = 1;
  static constexpr std::array<double, kNodes> kPointShares{1.0 / 3, 1.0 / 3, 1.0 / 3};

  static const std::array<QuadraturePoint, kPoints>& points() { return triangular_face_points(); }
  static Vec3 shape(const Vec3& L) { return L; }
  static Eigen::Matrix<double, kNodes, 2> slopes(const Vec3&) {
    Eigen::Matrix<double, kNodes, 2> by_L;
    by_L << -1, -1, 1, 0, 0, 1;
    return by_L;
  }
};

static_assert(Face<Tri3>);

}  // namespace orthodyn
