// The bilinear quadrilateral, a face of Hex8 and Wedge6: corners 0 to 3.
#pragma once

#include "lib/element/cube_functions.h"
#include "lib/element/face.h"

namespace orthodyn {

struct Quad4 {
  static constexpr int kNodes = 4, kPoints = 9, kTangentPoints = 9;
  static constexpr std::array<double, kNodes> kPointShares{0.25, 0.25, 0.25, 0.25};

  static const std::array<QuadraturePoint, kPoints>& points() { return square_points_of_degree_5(); }
  static Eigen::Matrix<double, kNodes, 1> shape(const Vec3& place) {
    Eigen::Matrix<double, kNodes, 1> N;
    for (int a = 0; a < kNodes; ++a) N[a] = multilinear<2>(square_nodes().col(a), place.head<2>()).value;
    return N;
  }
  static Eigen::Matrix<double, kNodes, 2> slopes(const Vec3& place) {
    Eigen::Matrix<double, kNodes, 2> by_place;
    for (int a = 0; a < kNodes; ++a) by_place.row(a) = multilinear<2>(square_nodes().col(a), place.head<2>()).slopes;
    return by_place;
  }
};

static_assert(Face<Quad4>);

}  // namespace orthodyn
