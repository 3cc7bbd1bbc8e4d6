// The element concept: shape functions and integration points of a cell.
//
// Shape functions N_a sum to one, so H = F - I = sum_a u_a grad N_a = sum_{a>0} (u_a - u_0) grad N_a: only gradients of
// nodes 1, 2, ... are stored, and the force on node 0 is minus the sum of the other forces. Gradients are in material
// axes, g_a = Q^T grad N_a with the axes as columns of Q, so functions return H Q instead of H and take P Q instead of
// P.
//
// Each element has its own file: a struct E with static, pure functions that satisfies the concept below.
// ElementTypeOf<E> (lib/fem/element_type_of.h) makes it an ElementType.
#pragma once

#include <array>
#include <concepts>

#include "lib/core/cell_shape.h"
#include "lib/core/types.h"
#include "lib/element/quadrature.h"

namespace orthodyn {

// Node positions of an element, one column per node, m.
template <int kNodes>
using ElementNodes = Eigen::Matrix<double, 3, kNodes>;

// u_a - u_0 for a = 1, 2, ... (m); likewise for positions (m) and velocities (m/s).
template <int kNodes>
using NodeDifferences = Eigen::Matrix<double, 3, kNodes - 1>;

template <int kNodes>
NodeDifferences<kNodes> differences(const ElementNodes<kNodes>& x) {
  return x.template rightCols<kNodes - 1>().colwise() - x.col(0);
}

// One integration point of an element, or of a batch of elements (T = Batch).
template <int kNodes, class T = double>
struct ElementPoint {
  Eigen::Matrix<T, kNodes - 1, 3> B;  // rows: the gradients g_a of nodes 1, 2, ..., 1/m
  T volume;                           // the point's share of the element's volume, m^3

  // Returns H Q from differences of displacements, F Q from those of positions, F_rate Q from those of velocities.
  Mat3 gradient(const NodeDifferences<kNodes>& d) const { return d.lazyProduct(B); }

  // Columns: the forces -V dPsi/dx on nodes 1, 2, ... (N) for the stress P Q (Pa).
  NodeDifferences<kNodes> node_forces(const Mat3& P) const { return -volume * P * B.transpose(); }
};

template <class E>
concept Element = requires(int point, NodeDifferences<E::kNodes> d, ElementNodes<E::kNodes> X, Mat3 Q, double density) {
  { E::kShape } -> std::convertible_to<CellShape>;  // defines the node order
  { E::kNodes } -> std::convertible_to<int>;
  { E::kPoints } -> std::convertible_to<int>;
  // Each node's share of the lumped mass: positive, with sum 1.
  { E::kLumpedShares } -> std::convertible_to<std::array<double, E::kNodes>>;
  // The largest ratio of lumped to consistent kinetic energy.
  { E::kLumpedToConsistent } -> std::convertible_to<double>;
  // Number of polynomials of the pressure in an element of the mixed formulation (lib/fem/terms/mixed_elastic_term.h):
  // 1 constant, 4 linear, 0 if the element has no such formulation.
  { E::kPressures } -> std::convertible_to<int>;
  // Point `point` in [0, kPoints), from the node differences at rest and the material axes.
  { E::point(point, d, Q) } -> std::same_as<ElementPoint<E::kNodes>>;
  { E::place_of(point, X) } -> std::same_as<Vec3>;  // rest position of the point, m
  // The largest d such that the shape functions span all polynomials of degree d.
  { E::kDegree } -> std::convertible_to<int>;
  // Extrapolates point values to the nodes by the polynomial through the points.
  { E::points_to_nodes() } -> std::same_as<Eigen::Matrix<double, E::kNodes, E::kPoints>>;
  { E::mass(X, density) } -> std::same_as<double>;  // kg, density in kg/m^3
  // integral of rho N_a N_b dV, kg.
  { E::consistent_mass(X, density) } -> std::same_as<Eigen::Matrix<double, E::kNodes, E::kNodes>>;
};

// An isoparametric element (isoparametric.h), which can be integrated by any IntegrationRule, not only at its own
// kPoints.
template <class E>
concept HasIntegrationRules = Element<E> &&
    requires(QuadraturePoint at, NodeDifferences<E::kNodes> d, Vec3 xi, Mat3 Q, IntegrationRule rule) {
  { E::point(at, d, Q) } -> std::same_as<ElementPoint<E::kNodes>>;
  { E::slopes(at) } -> std::same_as<Eigen::Matrix<double, E::kNodes - 1, 3>>;  // dN_a/dxi of the nodes 1, 2, ...
  { E::shape(xi) } -> std::same_as<Eigen::Matrix<double, E::kNodes, 1>>;
  { E::own_rule() } -> std::same_as<IntegrationRule>;
  { E::part_of_rule(rule, -1.0, 1.0) } -> std::same_as<IntegrationRule>;
};

}  // namespace orthodyn
