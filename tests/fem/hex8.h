// A trilinear brick with 2 x 2 x 2 points: an element that only tests have. Nodes as in VTK_HEXAHEDRON.
#pragma once

#include <Eigen/LU>
#include <cmath>

#include "lib/element/element.h"

namespace orthodyn {

struct Hex8 {
  static constexpr CellShape kShape = CellShape::hex8;
  static constexpr int kNodes = 8, kPoints = 8, kDegree = 1;
  static constexpr std::array<double, kNodes> kLumpedShares{.125, .125, .125, .125, .125, .125, .125, .125};
  static constexpr int kPressures = 0;
  static constexpr double kLumpedToConsistent = 27;  // of a parallelepiped: 3 in each direction

  // Corner `a` of [-1, 1]^3; Gauss points are the corners of a cube 1/sqrt(3) as large.
  static Vec3 corner(int a) { return {(a + 1) % 4 < 2 ? -1.0 : 1.0, a % 4 < 2 ? -1.0 : 1.0, a < 4 ? -1.0 : 1.0}; }
  static Vec3 gauss_point(int p) { return corner(p) / std::sqrt(3.0); }

  static double shape(int a, const Vec3& xi) { return ((Vec3::Ones() + corner(a).cwiseProduct(xi)) / 2).prod(); }
  static Vec3 shape_gradient(int a, const Vec3& xi) {
    const Vec3 c = corner(a), n = (Vec3::Ones() + c.cwiseProduct(xi)) / 2;
    return Vec3(c[0] * n[1] * n[2], c[1] * n[2] * n[0], c[2] * n[0] * n[1]) / 2;
  }

  static ElementPoint<kNodes> point(int p, const NodeDifferences<kNodes>& d, const Mat3& Q) {
    Eigen::Matrix<double, kNodes - 1, 3> slopes;
    for (int a = 1; a < kNodes; ++a) slopes.row(a - 1) = shape_gradient(a, gauss_point(p));
    const Mat3 J = d * slopes;
    return {slopes * J.inverse() * Q, J.determinant()};
  }

  static Vec3 place_of(int p, const ElementNodes<kNodes>& X) {
    Vec3 at = Vec3::Zero();
    for (int a = 0; a < kNodes; ++a) at += shape(a, gauss_point(p)) * X.col(a);
    return at;
  }

  // Trilinear in xi sqrt(3), of which the points are the corners.
  static Eigen::Matrix<double, kNodes, kPoints> points_to_nodes() {
    Eigen::Matrix<double, kNodes, kPoints> E;
    for (int a = 0; a < kNodes; ++a)
      for (int p = 0; p < kPoints; ++p) E(a, p) = shape(p, std::sqrt(3.0) * corner(a));
    return E;
  }

  static double mass(const ElementNodes<kNodes>& X, double density) {
    double volume = 0;
    for (int p = 0; p < kPoints; ++p) volume += point(p, differences<kNodes>(X), Mat3::Identity()).volume;
    return density * volume;
  }

  static Eigen::Matrix<double, kNodes, kNodes> consistent_mass(const ElementNodes<kNodes>& X, double density) {
    Eigen::Matrix<double, kNodes, kNodes> M = Eigen::Matrix<double, kNodes, kNodes>::Zero();
    for (int p = 0; p < kPoints; ++p) {
      const double m = density * point(p, differences<kNodes>(X), Mat3::Identity()).volume;
      for (int a = 0; a < kNodes; ++a)
        for (int b = 0; b < kNodes; ++b) M(a, b) += m * shape(a, gauss_point(p)) * shape(b, gauss_point(p));
    }
    return M;
  }
};

static_assert(Element<Hex8>);

}  // namespace orthodyn
