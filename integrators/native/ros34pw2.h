// ROS34PW2 (Rang & Angermann 2005): four stages, order 3 with any matrix instead of the Jacobian, embedded order 2,
// stiffly accurate, L-stable with the exact Jacobian. For y' = f(y) with Jacobian J, in the notation of Hairer & Wanner
// (1996), IV.7:
//
//   k_i = h f(y0 + sum_j alpha_ij k_j) + h J sum_j gamma_ij k_j,   y1 = y0 + sum_i b_i k_i
#pragma once

#include "lib/core/types.h"

namespace orthodyn {

struct Ros34Pw2 {
  using Matrix4 = Eigen::Matrix4d;
  using Vector4 = Eigen::Vector4d;

  static constexpr double kGamma = 4.3586652150845900e-01;

  Matrix4 alpha{{0, 0, 0, 0},
                {8.7173304301691801e-01, 0, 0, 0},
                {8.4457060015369423e-01, -1.1299064236484185e-01, 0, 0},
                {0, 0, 1, 0}};
  Matrix4 gamma{{kGamma, 0, 0, 0},
                {-8.7173304301691801e-01, kGamma, 0, 0},
                {-9.0338057013044082e-01, 5.4180672388095326e-02, kGamma, 0},
                {2.4212380706095346e-01, -1.2232505839045147e+00, 5.4526025533510214e-01, kGamma}};
  Vector4 b{2.4212380706095346e-01, -1.2232505839045147e+00, 1.5452602553351020e+00, kGamma};
  Vector4 embedded{3.7810903145819369e-01, -9.6042292212423178e-02, 0.5, 2.1793326075422950e-01};
};

}  // namespace orthodyn
