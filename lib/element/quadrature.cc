#include "lib/element/quadrature.h"

#include <array>
#include <cmath>

namespace orthodyn {

namespace {

struct LinePoint {
  double x, weight;  // on [0, 1]
};

// Abramowitz & Stegun 25.4.30.
std::array<LinePoint, 5> gauss_legendre_5() {
  const double near = std::sqrt(5 - 2 * std::sqrt(10.0 / 7)) / 3, far = std::sqrt(5 + 2 * std::sqrt(10.0 / 7)) / 3;
  const double near_weight = (322 + 13 * std::sqrt(70.0)) / 1800, far_weight = (322 - 13 * std::sqrt(70.0)) / 1800;
  return {{{(1 - far) / 2, far_weight},
           {(1 - near) / 2, near_weight},
           {0.5, 64.0 / 225},
           {(1 + near) / 2, near_weight},
           {(1 + far) / 2, far_weight}}};
}

}  // namespace

const std::vector<TetrahedronPoint>& tetrahedron_points_of_degree_7() {
  static const std::vector<TetrahedronPoint> all = [] {
    std::vector<TetrahedronPoint> points;
    const auto line = gauss_legendre_5();
    for (const auto& [r, w_r] : line)
      for (const auto& [s, w_s] : line)
        for (const auto& [t, w_t] : line) {
          const double L1 = r, L2 = (1 - r) * s, L3 = (1 - r) * (1 - s) * t;
          points.push_back({{1 - L1 - L2 - L3, L1, L2, L3}, w_r * w_s * w_t * (1 - r) * (1 - r) * (1 - s)});
        }
    return points;
  }();
  return all;
}

const std::array<TrianglePoint, 7>& triangle_points_of_degree_5() {
  static constexpr double root = 3.872983346207417;  // sqrt(15)
  static constexpr double a = (6 - root) / 21, b = (6 + root) / 21;
  static constexpr double near_corner = (155 - root) / 1200, near_side = (155 + root) / 1200;
  static const std::array<TrianglePoint, 7> all{{{Vec3::Constant(1.0 / 3), 9.0 / 40},
                                                 {{1 - 2 * a, a, a}, near_corner},
                                                 {{a, 1 - 2 * a, a}, near_corner},
                                                 {{a, a, 1 - 2 * a}, near_corner},
                                                 {{1 - 2 * b, b, b}, near_side},
                                                 {{b, 1 - 2 * b, b}, near_side},
                                                 {{b, b, 1 - 2 * b}, near_side}}};
  return all;
}

}  // namespace orthodyn
