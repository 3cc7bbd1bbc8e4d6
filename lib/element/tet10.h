// The quadratic tetrahedron: corners 0 to 3 as in tet4.h, then one node per edge in the order of kEdges. With the
// barycentric coordinates L_0 to L_3 (Zienkiewicz & Taylor 2000, vol. 1, 8.8):
//
//   N_i = L_i (2 L_i - 1) at corners,  N_ij = 4 L_i L_j on edges.
//
// Stiffness: 4 points, degree 2 (Hammer & Stroud 1956). The rule is exact for linear strain in an element with straight
// edges, and the stiffness has full rank: 4 x 6 strains = 30 displacements - 6 rigid motions. Mass: Gauss points in
// collapsed coordinates, degree 7; exact for N_a N_b det J, also for curved edges. Lumped mass: the diagonal of the
// consistent mass for straight edges, scaled to the total mass (Hinton, Rock & Zienkiewicz 1976), because the row sums
// of the corners are negative.
#pragma once

#include <Eigen/LU>

#include "lib/element/element.h"
#include "lib/element/quadrature.h"

namespace orthodyn {

struct Tet10 {
  static constexpr CellShape kShape = CellShape::tet10;
  static constexpr int kNodes = 10, kPoints = 4, kDegree = 2;
  static constexpr std::array<std::array<int, 2>, 6> kEdges{{{0, 1}, {1, 2}, {0, 2}, {0, 3}, {1, 3}, {2, 3}}};
  static constexpr double kCorner = 1.0 / 36, kMiddle = 4.0 / 27;
  static constexpr std::array<double, kNodes> kLumpedShares{kCorner, kCorner, kCorner, kCorner, kMiddle,
                                                            kMiddle, kMiddle, kMiddle, kMiddle, kMiddle};
  static constexpr double kLumpedToConsistent = 70.0 / 9;  // with straight edges
  static constexpr int kPressures = 1;

  using Barycentric = Eigen::Vector4d;
  using Values = Eigen::Matrix<double, kNodes, 1>;
  using Slopes = Eigen::Matrix<double, kNodes, 3>;  // derivatives with respect to L_1, L_2, L_3

  static Values shape(const Barycentric& L) {
    Values N;
    for (int i = 0; i < 4; ++i) N[i] = L[i] * (2 * L[i] - 1);
    for (int e = 0; e < 6; ++e) N[4 + e] = 4 * L[edge(e)[0]] * L[edge(e)[1]];
    return N;
  }

  static Slopes shape_slopes(const Barycentric& L) {
    Eigen::Matrix<double, kNodes, 4> by_L = Eigen::Matrix<double, kNodes, 4>::Zero();
    for (int i = 0; i < 4; ++i) by_L(i, i) = 4 * L[i] - 1;
    for (int e = 0; e < 6; ++e) {
      const auto [i, j] = edge(e);
      by_L(4 + e, i) = 4 * L[j];
      by_L(4 + e, j) = 4 * L[i];
    }
    return by_L.rightCols<3>().colwise() - by_L.col(0);
  }

  // dX/dL, m; for straight edges its determinant is six times the element's volume.
  static Mat3 jacobian(const NodeDifferences<kNodes>& rest, const Barycentric& L) {
    return rest * shape_slopes(L).bottomRows<kNodes - 1>();
  }

  static Barycentric place(int point) {
    static constexpr double root = 2.23606797749979;  // sqrt(5)
    Barycentric L = Barycentric::Constant((5 - root) / 20);
    L[point] = (5 + 3 * root) / 20;
    return L;
  }

  // The places where the Jacobian is checked: nodes, and integration points of stiffness and mass.
  static const std::vector<Barycentric>& checked_places() {
    static const std::vector<Barycentric> all = [] {
      std::vector<Barycentric> places;
      for (int p = 0; p < kPoints; ++p) places.push_back(place(p));
      for (int i = 0; i < 4; ++i) places.push_back(Barycentric::Unit(i));
      for (const auto& [i, j] : kEdges) places.push_back((Barycentric::Unit(i) + Barycentric::Unit(j)) / 2);
      for (const TetrahedronPoint& at : tetrahedron_points_of_degree_7()) places.push_back(at.L);
      return places;
    }();
    return all;
  }

  static ElementPoint<kNodes> point(int p, const NodeDifferences<kNodes>& rest, const Mat3& Q) {
    const auto slopes = shape_slopes(place(p)).bottomRows<kNodes - 1>().eval();
    const Mat3 J = rest * slopes;
    return {slopes * J.inverse() * Q, J.determinant() / 24};
  }

  static Vec3 place_of(int p, const ElementNodes<kNodes>& X) { return X * shape(place(p)); }

  // Extrapolates linear functions: one with values c_i at the corners is sum L_i(node) c_i at a node and sum L_i(point)
  // c_i at a point.
  static Eigen::Matrix<double, kNodes, kPoints> points_to_nodes() {
    Eigen::Matrix<double, kNodes, 4> at_nodes = Eigen::Matrix<double, kNodes, 4>::Zero();
    Eigen::Matrix4d at_points;
    for (int i = 0; i < 4; ++i) at_nodes(i, i) = 1;
    for (int e = 0; e < 6; ++e)
      for (const int i : edge(e)) at_nodes(4 + e, i) = 0.5;
    for (int p = 0; p < kPoints; ++p) at_points.row(p) = place(p).transpose();
    return at_nodes * at_points.inverse();
  }

  static double mass(const ElementNodes<kNodes>& X, double density) {
    const NodeDifferences<kNodes> rest = differences<kNodes>(X);
    if (has_straight_edges(rest)) return density * rest.leftCols<3>().determinant() / 6;
    double volume = 0;
    for (const MassPoint& p : mass_points()) volume += p.weight * (rest * p.slopes).determinant();
    return density * volume;
  }

  static Eigen::Matrix<double, kNodes, kNodes> consistent_mass(const ElementNodes<kNodes>& X, double density) {
    using Matrix = Eigen::Matrix<double, kNodes, kNodes>;
    const auto integral = [](auto&& determinant_at) {
      Matrix M = Matrix::Zero();
      for (const MassPoint& p : mass_points()) M += p.weight * determinant_at(p) * p.N * p.N.transpose();
      return M;
    };
    static const Matrix of_unit_determinant = integral([](const MassPoint&) { return 1.0; });
    const NodeDifferences<kNodes> rest = differences<kNodes>(X);
    if (has_straight_edges(rest)) return density * rest.leftCols<3>().determinant() * of_unit_determinant;
    return density * integral([&](const MassPoint& p) { return (rest * p.slopes).determinant(); });
  }

 private:
  struct MassPoint {
    Values N;
    Eigen::Matrix<double, kNodes - 1, 3> slopes;
    double weight;  // sum 1/6
  };

  // Then the Jacobian is the same everywhere.
  static bool has_straight_edges(const NodeDifferences<kNodes>& rest) {
    constexpr double kRoundOff = 1e-12;
    const auto at = [&](int node) { return node == 0 ? Vec3(Vec3::Zero()) : Vec3(rest.col(node - 1)); };
    for (int e = 0; e < 6; ++e) {
      const Vec3 begin = at(edge(e)[0]), end = at(edge(e)[1]);
      if ((begin + end - 2 * at(4 + e)).norm() > kRoundOff * (end - begin).norm()) return false;
    }
    return true;
  }

  static const std::array<int, 2>& edge(int e) { return kEdges[static_cast<std::size_t>(e)]; }

  static const std::vector<MassPoint>& mass_points() {
    static const std::vector<MassPoint> all = [] {
      std::vector<MassPoint> points;
      for (const TetrahedronPoint& at : tetrahedron_points_of_degree_7())
        points.push_back({shape(at.L), shape_slopes(at.L).bottomRows<kNodes - 1>(), at.weight});
      return points;
    }();
    return all;
  }
};

static_assert(Element<Tet10>);

}  // namespace orthodyn
