// An element: how the nodes of a cell interpolate, and where the law is evaluated.
//
// With shape functions N_a that sum to one, H = F - I = sum_a u_a grad N_a = sum_{a>0} (u_a - u_0) grad N_a: only the
// gradients of nodes 1, 2, ... are kept, and node 0 takes minus the sum of the others' forces. Gradients are in
// material axes, g_a = Q^T grad N_a with the axes as columns of Q, so that all products are H Q and P Q.
//
// One element per file. A struct E with static members is an element if it satisfies the concept below; fem is
// compiled for it by ElementTypeOf<E> (lib/fem/element_type_of.h). All functions are pure.
#pragma once

#include <array>
#include <concepts>

#include "lib/core/types.h"

namespace orthodyn {

// Positions of the nodes of an element, a column each, m.
template <int kNodes>
using ElementNodes = Eigen::Matrix<double, 3, kNodes>;

// u_a - u_0 for a = 1, 2, ..., m; of positions likewise, or of velocities, m/s.
template <int kNodes>
using NodeDifferences = Eigen::Matrix<double, 3, kNodes - 1>;

template <int kNodes>
NodeDifferences<kNodes> differences(const ElementNodes<kNodes>& x) {
  return x.template rightCols<kNodes - 1>().colwise() - x.col(0);
}

// One integration point of an element, or of a batch of them (T = Batch).
template <int kNodes, class T = double>
struct ElementPoint {
  Eigen::Matrix<T, kNodes - 1, 3> B;  // rows: the gradients g_a of nodes 1, 2, ..., 1/m
  T volume;                           // its part of the element's, m^3

  // H Q from differences of displacements, F Q from those of positions, F_rate Q from those of velocities.
  Mat3 gradient(const NodeDifferences<kNodes>& d) const { return d.lazyProduct(B); }

  // Columns: the forces -V dPsi/dx on nodes 1, 2, ... (N) for the stress P Q (Pa).
  NodeDifferences<kNodes> node_forces(const Mat3& P) const { return -volume * P * B.transpose(); }
};

template <class E>
concept Element = requires(int point, NodeDifferences<E::kNodes> d, ElementNodes<E::kNodes> X, Mat3 Q, double density) {
  { E::kName } -> std::convertible_to<const char*>;
  { E::kNodes } -> std::convertible_to<int>;
  { E::kPoints } -> std::convertible_to<int>;
  { E::kVtkCellType } -> std::convertible_to<int>;  // whose node order is the element's
  // The share of each node in the lumped mass. All positive, with sum 1.
  { E::kLumpedShares } -> std::convertible_to<std::array<double, E::kNodes>>;
  // The largest ratio of lumped to consistent kinetic energy.
  { E::kLumpedToConsistent } -> std::convertible_to<double>;
  // Point number `point` of [0, kPoints) of an element with these node differences at rest and these axes.
  { E::point(point, d, Q) } -> std::same_as<ElementPoint<E::kNodes>>;
  { E::place_of(point, X) } -> std::same_as<Vec3>;  // m, at rest
  // Of complete polynomials that the shape functions hold.
  { E::kDegree } -> std::convertible_to<int>;
  // Takes values at the points to the nodes, along the polynomial through the points.
  { E::points_to_nodes() } -> std::same_as<Eigen::Matrix<double, E::kNodes, E::kPoints>>;
  { E::mass(X, density) } -> std::same_as<double>;  // kg, density in kg/m^3
  // integral of rho N_a N_b dV, kg.
  { E::consistent_mass(X, density) } -> std::same_as<Eigen::Matrix<double, E::kNodes, E::kNodes>>;
};

}  // namespace orthodyn
