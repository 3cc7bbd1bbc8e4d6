#include "lib/element/quadrature.h"

#include <Eigen/LU>
#include <array>
#include <cmath>

namespace orthodyn {

namespace {

struct UnitLinePoint {
  double x, weight;  // on [0, 1]
};

// Abramowitz & Stegun 25.4.30.
std::array<UnitLinePoint, 5> gauss_legendre_5() {
  const double near = std::sqrt(5 - 2 * std::sqrt(10.0 / 7)) / 3, far = std::sqrt(5 + 2 * std::sqrt(10.0 / 7)) / 3;
  const double near_weight = (322 + 13 * std::sqrt(70.0)) / 1800, far_weight = (322 - 13 * std::sqrt(70.0)) / 1800;
  return {{{(1 - far) / 2, far_weight},
           {(1 - near) / 2, near_weight},
           {0.5, 64.0 / 225},
           {(1 + near) / 2, near_weight},
           {(1 + far) / 2, far_weight}}};
}

// The three points whose barycentric coordinates are a, a and 1 - 2a.
void add_triangle_orbit(double a, double weight, std::vector<TrianglePoint>& points) {
  for (int i = 0; i < 3; ++i) {
    Vec3 L = Vec3::Constant(a);
    L[i] = 1 - 2 * a;
    points.push_back({L, weight});
  }
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

const std::vector<TrianglePoint>& triangle_points_of_degree_2() {
  static const std::vector<TrianglePoint> all = [] {
    std::vector<TrianglePoint> points;
    add_triangle_orbit(1.0 / 6, 1.0 / 3, points);
    return points;
  }();
  return all;
}

const std::vector<TrianglePoint>& triangle_points_of_degree_4() {
  static const std::vector<TrianglePoint> all = [] {
    const double middle = 8 - std::sqrt(10.0), spread = std::sqrt(38 - 44 * std::sqrt(0.4));
    const double weight_spread = std::sqrt(213125 - 53320 * std::sqrt(10.0));
    std::vector<TrianglePoint> points;
    add_triangle_orbit((middle - spread) / 18, (620 - weight_spread) / 3720, points);
    add_triangle_orbit((middle + spread) / 18, (620 + weight_spread) / 3720, points);
    return points;
  }();
  return all;
}

const std::vector<LinePoint>& line_points_of_degree_3() {
  static const std::vector<LinePoint> all{{-1 / std::sqrt(3.0), 1}, {1 / std::sqrt(3.0), 1}};
  return all;
}

const std::vector<LinePoint>& line_points_of_degree_5() {
  static const std::vector<LinePoint> all{{-std::sqrt(0.6), 5.0 / 9}, {0, 8.0 / 9}, {std::sqrt(0.6), 5.0 / 9}};
  return all;
}

const std::array<QuadraturePoint, 9>& square_points_of_degree_5() {
  static const std::array<QuadraturePoint, 9> all = [] {
    std::array<QuadraturePoint, 9> points;
    std::size_t p = 0;
    for (const auto& [y, w_y] : line_points_of_degree_5())
      for (const auto& [x, w_x] : line_points_of_degree_5()) points[p++] = {{x, y, 0}, w_x * w_y};
    return points;
  }();
  return all;
}

std::vector<QuadraturePoint> cube_points(const std::vector<LinePoint>& line) {
  std::vector<QuadraturePoint> points;
  for (const auto& [z, w_z] : line)
    for (const auto& [y, w_y] : line)
      for (const auto& [x, w_x] : line) points.push_back({{x, y, z}, w_x * w_y * w_z});
  return points;
}

std::vector<QuadraturePoint> irons_points() {
  const double face = std::sqrt(19.0 / 30), corner = std::sqrt(19.0 / 33);
  std::vector<QuadraturePoint> points;
  for (int i = 0; i < 3; ++i)
    for (const double sign : {-1.0, 1.0}) points.push_back({sign * face * Vec3::Unit(i), 320.0 / 361});
  for (const double z : {-corner, corner})
    for (const double y : {-corner, corner})
      for (const double x : {-corner, corner}) points.push_back({{x, y, z}, 121.0 / 361});
  return points;
}

std::vector<QuadraturePoint> wedge_points(const std::vector<TrianglePoint>& triangle,
                                          const std::vector<LinePoint>& line) {
  std::vector<QuadraturePoint> points;
  for (const auto& [t, w_t] : line)
    for (const auto& [L, share] : triangle) points.push_back({{L[1], L[2], t}, 0.5 * share * w_t});
  return points;
}

Eigen::MatrixXd extrapolation_matrix(const Eigen::MatrixXd& at_nodes, const Eigen::MatrixXd& at_points) {
  return at_nodes * at_points.inverse();
}

}  // namespace orthodyn
