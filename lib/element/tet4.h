// The linear tetrahedron: constant gradients, one point. Nodes 0 to 3 with (x1 - x0) . ((x2 - x0) x (x3 - x0)) > 0.
#pragma once

#include "lib/element/element.h"

namespace orthodyn {

struct Tet4 {
  static constexpr CellShape kShape = CellShape::tet4;
  static constexpr int kNodes = 4, kPoints = 1, kDegree = 1;
  static constexpr std::array<double, kNodes> kLumpedShares{0.25, 0.25, 0.25, 0.25};
  static constexpr double kLumpedToConsistent = 5;  // m/4 over the smallest eigenvalue of the consistent mass, m/20
  static constexpr int kPressures = 0;

  static ElementPoint<kNodes> point(int, const NodeDifferences<kNodes>& edges, const Mat3& Q) {
    return {edges.inverse() * Q, edges.determinant() / 6};
  }

  static Vec3 place_of(int, const ElementNodes<kNodes>& X) { return X.rowwise().sum() / 4; }

  static Eigen::Vector4d points_to_nodes() { return Eigen::Vector4d::Ones(); }

  static double mass(const ElementNodes<kNodes>& X, double density) {
    const Vec3 a = X.col(1) - X.col(0), b = X.col(2) - X.col(0), c = X.col(3) - X.col(0);
    return density * a.dot(b.cross(c)) / 6;
  }

  // M_ab = m/20 (1 + delta_ab) for the element's mass m.
  static Eigen::Matrix4d consistent_mass(const ElementNodes<kNodes>& X, double density) {
    const double m = mass(X, density);
    Eigen::Matrix4d M = Eigen::Matrix4d::Constant(m / 20);
    M.diagonal().setConstant(2 * m / 20);
    return M;
  }
};

static_assert(Element<Tet4>);

}  // namespace orthodyn
