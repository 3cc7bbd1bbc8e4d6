// The linear triangle in space, the face of a linear tetrahedron.
#pragma once

#include <array>

#include "lib/core/types.h"

namespace orthodyn {

struct Tri3 {
  static constexpr int kNodes = 3;
  using Nodes = Eigen::Matrix<double, 3, kNodes>;  // positions, a column each, m

  static double area(const Nodes& X) {
    return 0.5 * Vec3(X.col(1) - X.col(0)).cross(Vec3(X.col(2) - X.col(0))).norm();
  }

  // integral of N_a dA for each node, m^2.
  static std::array<double, kNodes> node_areas(const Nodes& X) {
    const double third = area(X) / 3;
    return {third, third, third};
  }

  // An integration point: the shape functions there, which are its barycentric coordinates, and its share of the area.
  struct Point {
    Vec3 N;
    double weight;
  };

  // Exact for polynomials of degree 5 (Radon 1948, Zur mechanischen Kubatur).
  static const std::array<Point, 7>& points() {
    static constexpr double root = 3.872983346207417;  // of 15
    static constexpr double a = (6 - root) / 21, b = (6 + root) / 21;
    static constexpr double near_corner = (155 - root) / 1200, near_side = (155 + root) / 1200;
    static const std::array<Point, 7> all{{{Vec3::Constant(1.0 / 3), 9.0 / 40},
                                           {{1 - 2 * a, a, a}, near_corner},
                                           {{a, 1 - 2 * a, a}, near_corner},
                                           {{a, a, 1 - 2 * a}, near_corner},
                                           {{1 - 2 * b, b, b}, near_side},
                                           {{b, 1 - 2 * b, b}, near_side},
                                           {{b, b, 1 - 2 * b}, near_side}}};
    return all;
  }

  // The means of N_a g over the triangle, for a scalar field g of the position: exact for polynomials of degree 4.
  template <class Field>
  static Vec3 node_means(const Nodes& X, const Field& g) {
    Vec3 means = Vec3::Zero();
    for (const auto& [N, weight] : points()) means += weight * g(Vec3(X * N)) * N;
    return means;
  }
};

}  // namespace orthodyn
