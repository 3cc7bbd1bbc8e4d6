// The biquadratic quadrilateral, a face of Hex27 and Wedge18: the nodes of Quad8 and the centre.
#pragma once

#include "lib/element/cube_functions.h"
#include "lib/element/face.h"

namespace orthodyn {

struct Quad9 {
  static constexpr int kNodes = 9, kPoints = 9, kTangentPoints = 9;
  // The integrals of N_a over a parallelogram of area 1: products of 1/6, 4/6, 1/6.
  static constexpr double kCorner = 1.0 / 36, kMiddle = 4.0 / 36, kCentre = 16.0 / 36;
  static constexpr std::array<double, kNodes> kPointShares{kCorner, kCorner, kCorner, kCorner, kMiddle,
                                                           kMiddle, kMiddle, kMiddle, kCentre};

  static const std::array<QuadraturePoint, kPoints>& points() { return square_points_of_degree_5(); }
  static Eigen::Matrix<double, kNodes, 1> shape(const Vec3& place) {
    Eigen::Matrix<double, kNodes, 1> N;
    for (int a = 0; a < kNodes; ++a) N[a] = lagrange<2>(square_nodes().col(a), place.head<2>()).value;
    return N;
  }
  static Eigen::Matrix<double, kNodes, 2> slopes(const Vec3& place) {
    Eigen::Matrix<double, kNodes, 2> by_place;
    for (int a = 0; a < kNodes; ++a) by_place.row(a) = lagrange<2>(square_nodes().col(a), place.head<2>()).slopes;
    return by_place;
  }
};

static_assert(Face<Quad9>);

}  // namespace orthodyn
