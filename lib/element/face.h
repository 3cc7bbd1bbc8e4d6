// The face concept: shape functions of an element's face in space.
//
// A face is a struct F with static members that satisfies the concept below. Nodes are in VTK order: corners first,
// counterclockwise as seen from outside the body.
#pragma once

#include <array>
#include <concepts>

#include "lib/element/quadrature.h"

namespace orthodyn {

template <class F>
concept Face = requires(Vec3 place) {
  { F::kNodes } -> std::convertible_to<int>;
  // Quadrature points of the face: its integral of g is sum weight * |normal_at<F>(X, place)| * g.
  { F::kPoints } -> std::convertible_to<int>;
  { F::points() } -> std::same_as<const std::array<QuadraturePoint, F::kPoints>&>;
  // Number of points needed to integrate (tangent x tangent) times a function of the rest position: one if the tangents
  // are constant, else kPoints.
  { F::kTangentPoints } -> std::convertible_to<int>;
  // Shape functions at natural coordinates, and their derivatives in two directions whose cross product points outward:
  // barycentric coordinates (L_0, L_1, L_2) of a triangle, derivatives with respect to L_1 and L_2; (x, y, 0) of a
  // quadrilateral with x and y in [-1, 1], derivatives with respect to x and y.
  { F::shape(place) } -> std::same_as<Eigen::Matrix<double, F::kNodes, 1>>;
  { F::slopes(place) } -> std::same_as<Eigen::Matrix<double, F::kNodes, 2>>;
  // Each node's share of the area, for forces at points such as those of contact. Positive; the rest of the area is
  // that of the middle of a face of six or eight nodes (lib/fem/contact/face_middles.h).
  { F::kPointShares } -> std::convertible_to<std::array<double, F::kNodes>>;
};

// Node positions, one column per node, m.
template <Face F>
using FaceNodes = Eigen::Matrix<double, 3, F::kNodes>;

// The points of triangles, in barycentric coordinates, with weights for normals that are twice the area vector.
inline const std::array<QuadraturePoint, 7>& triangular_face_points() {
  static const std::array<QuadraturePoint, 7> all = [] {
    std::array<QuadraturePoint, 7> points;
    std::size_t p = 0;
    for (const auto& [L, share] : triangle_points_of_degree_5()) points[p++] = {L, 0.5 * share};
    return points;
  }();
  return all;
}

// The cross product of the tangents at a point, m^2: twice the area vector of a plane triangle with straight edges, a
// quarter of the area vector of a parallelogram.
template <Face F>
Vec3 normal_at(const FaceNodes<F>& x, const Vec3& place) {
  const Eigen::Matrix<double, 3, 2> tangents = x * F::slopes(place);
  return tangents.col(0).cross(tangents.col(1));
}

// integral of N_a g dA, one column per node a, for a scalar or vector field g of position. Exact on a plane triangle
// with straight edges if N_a g is a polynomial of degree <= 5, and on a parallelogram if N_a g has degree <= 5 in each
// natural coordinate.
template <Face F, class Field>
auto node_integrals(const FaceNodes<F>& X, const Field& g) {
  using Value = std::decay_t<decltype(g(Vec3()))>;
  Eigen::Matrix<double, Value::RowsAtCompileTime, F::kNodes> sums;
  sums.setZero();
  for (const auto& [place, weight] : F::points()) {
    const auto N = F::shape(place);
    const Value value = weight * normal_at<F>(X, place).norm() * g(Vec3(X * N));
    sums += value * N.transpose();
  }
  return sums;
}

// The area of a face, m^2.
template <Face F>
double area(const FaceNodes<F>& X) {
  double sum = 0;
  for (const auto& [place, weight] : F::points()) sum += weight * normal_at<F>(X, place).norm();
  return sum;
}

}  // namespace orthodyn
