// A face of an element, in space: how its nodes interpolate.
//
// A struct F with static members is a face if it satisfies the concept below. Its nodes are in the order of VTK:
// corners first, counterclockwise from outside the body.
#pragma once

#include <concepts>

#include "lib/element/quadrature.h"

namespace orthodyn {

template <class F>
concept Face = requires(Vec3 L) {
  { F::kNodes } -> std::convertible_to<int>;
  // The fewest points that integrate (tangent x tangent) times any function of the rest position: one where the
  // tangents are the same everywhere, else those of triangle_points_of_degree_5().
  { F::kTangentPoints } -> std::convertible_to<int>;
  // At barycentric coordinates: the shape functions, and their slopes by L_1 and L_2.
  { F::shape(L) } -> std::same_as<Eigen::Matrix<double, F::kNodes, 1>>;
  { F::slopes(L) } -> std::same_as<Eigen::Matrix<double, F::kNodes, 2>>;
  // The share of each node where something acts on nodes alone, as contact does. All positive, with sum 1.
  { F::kNodeShares } -> std::convertible_to<std::array<double, F::kNodes>>;
};

// Positions of the nodes, a column each, m.
template <Face F>
using FaceNodes = Eigen::Matrix<double, 3, F::kNodes>;

// tangent x tangent at a point, m^2: twice the area vector per share of the area.
template <Face F>
Vec3 normal_at(const FaceNodes<F>& x, const Vec3& L) {
  const Eigen::Matrix<double, 3, 2> tangents = x * F::slopes(L);
  return tangents.col(0).cross(tangents.col(1));
}

// integral of N_a g dA for each node a and a scalar or vector field g of the position: a column each. Exact for
// polynomials of degree 5 less that of N_a where the face is plane with straight edges.
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

// m^2
template <Face F>
double area(const FaceNodes<F>& X) {
  double sum = 0;
  for (const auto& [L, weight] : triangle_points_of_degree_5()) sum += 0.5 * weight * normal_at<F>(X, L).norm();
  return sum;
}

}  // namespace orthodyn
