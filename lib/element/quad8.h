// The serendipity quadrilateral, a face of Hex20 and Wedge15: corners 0 to 3 and a node on each edge 01, 12, 23, 30.
#pragma once

#include "lib/element/cube_functions.h"
#include "lib/element/face.h"

namespace orthodyn {

struct Quad8 {
  static constexpr int kNodes = 8, kPoints = 9, kTangentPoints = 9;
  static constexpr double kCorner = 1.0 / 36, kEdge = 1.0 / 9;
  static constexpr std::array<double, kNodes> kPointShares{kCorner, kCorner, kCorner, kCorner,
                                                           kEdge,   kEdge,   kEdge,   kEdge};

  static const std::array<QuadraturePoint, kPoints>& points() { return square_points_of_degree_5(); }
  static Eigen::Matrix<double, kNodes, 1> shape(const Vec3& place) {
    Eigen::Matrix<double, kNodes, 1> N;
    for (int a = 0; a < kNodes; ++a) N[a] = serendipity<2>(square_nodes().col(a), place.head<2>()).value;
    return N;
  }
  static Eigen::Matrix<double, kNodes, 2> slopes(const Vec3& place) {
    Eigen::Matrix<double, kNodes, 2> by_place;
    for (int a = 0; a < kNodes; ++a) by_place.row(a) = serendipity<2>(square_nodes().col(a), place.head<2>()).slopes;
    return by_place;
  }
};

static_assert(Face<Quad8>);

}  // namespace orthodyn
