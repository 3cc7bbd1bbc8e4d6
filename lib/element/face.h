// The face concept: shape functions of an element's face in space.
//
// A face is a struct F with static members that satisfies the concept below. Nodes are in VTK order: corners first,
// counterclockwise as seen from outside the body.
#pragma once

#include <concepts>

#include "lib/element/quadrature.h"

namespace orthodyn {

template <class F>
concept Face = requires(Vec3 L) {
  { F::kNodes } -> std::convertible_to<int>;
  // Number of points needed to integrate (tangent x tangent) times a function of the rest position: one if the tangents
  // are constant, else those of triangle_points_of_degree_5().
  { F::kTangentPoints } -> std::convertible_to<int>;
  // Shape functions at barycentric coordinates L, and their derivatives with respect to L_1 and L_2.
  { F::shape(L) } -> std::same_as<Eigen::Matrix<double, F::kNodes, 1>>;
  { F::slopes(L) } -> std::same_as<Eigen::Matrix<double, F::kNodes, 2>>;
  // Each node's share of the area, for nodal forces such as contact: positive, with sum 1.
  { F::kNodeShares } -> std::convertible_to<std::array<double, F::kNodes>>;
};

// Node positions, one column per node, m.
template <Face F>
using FaceNodes = Eigen::Matrix<double, 3, F::kNodes>;

// The cross product of the tangents at a point, m^2: twice the area vector of a plane face with straight edges.
template <Face F>
Vec3 normal_at(const FaceNodes<F>& x, const Vec3& L) {
  const Eigen::Matrix<double, 3, 2> tangents = x * F::slopes(L);
  return tangents.col(0).cross(tangents.col(1));
}

// integral of N_a g dA, one column per node a, for a scalar or vector field g of position. Exact on a plane face with
// straight edges if N_a g is a polynomial of degree <= 5.
template <Face F, class Field>
auto node_integrals(const FaceNodes<F>& X, const Field& g) {
  using Value = std::decay_t<decltype(g(Vec3()))>;
  Eigen::Matrix<double, Value::RowsAtCompileTime, F::kNodes> sums;
  sums.setZero();
  for (const auto& [L, weight] : triangle_points_of_degree_5()) {
    const auto N = F::shape(L);
    const Value value = 0.5 * weight * normal_at<F>(X, L).norm() * g(Vec3(X * N));
    sums += value * N.transpose();
  }
  return sums;
}

// The area of a face, m^2.
template <Face F>
double area(const FaceNodes<F>& X) {
  double sum = 0;
  for (const auto& [L, weight] : triangle_points_of_degree_5()) sum += 0.5 * weight * normal_at<F>(X, L).norm();
  return sum;
}

}  // namespace orthodyn
