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
};

}  // namespace orthodyn
