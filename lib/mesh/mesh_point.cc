#include "lib/mesh/mesh_point.h"

#include <Eigen/LU>
#include <algorithm>
#include <limits>

#include "lib/mesh/element_of_shape.h"

namespace orthodyn {

namespace {

using Barycentric = Tet10::Barycentric;

Barycentric barycentric(const Mesh& mesh, std::span<const int> corners, const Vec3& place) {
  Mat3 edges;
  for (std::size_t i = 1; i < 4; ++i)
    edges.col(static_cast<Eigen::Index>(i) - 1) = mesh.node(corners[i]) - mesh.node(corners[0]);
  const Vec3 L = edges.inverse() * (place - mesh.node(corners[0]));
  return {1 - L.sum(), L[0], L[1], L[2]};
}

template <class E>
constexpr bool kIsHexahedron = E::kNodes == 8 || E::kNodes >= 20;

// Coordinates of a nearby point within the element.
Barycentric clamped(const Barycentric& L) {
  const Barycentric inside = L.cwiseMax(0);
  return inside / inside.sum();
}
template <class E>
Vec3 clamped(const Vec3& x) {
  if constexpr (kIsHexahedron<E>) {
    return x.cwiseMax(-1).cwiseMin(1);
  } else {
    Vec3 inside(std::max(x[0], 0.0), std::max(x[1], 0.0), std::clamp(x[2], -1.0, 1.0));
    if (const double sum = inside[0] + inside[1]; sum > 1) inside.head<2>() /= sum;
    return inside;
  }
}

// Newton's method, started at the centre of the element. Steps are limited, because the map may fold far outside.
template <class E>
Vec3 natural(const ElementNodes<E::kNodes>& X, const Vec3& place) {
  constexpr int kSteps = 20;
  constexpr double kFar = 2, kConverged = 1e-14;
  Vec3 x = kIsHexahedron<E> ? Vec3(0, 0, 0) : Vec3(1.0 / 3, 1.0 / 3, 0);
  const NodeDifferences<E::kNodes> rest = differences<E::kNodes>(X);
  for (int k = 0; k < kSteps; ++k) {
    const Vec3 step = E::jacobian(rest, x).inverse() * (place - X * E::shape(x));
    if (!step.allFinite()) break;
    x = (x + step).cwiseMax(-kFar).cwiseMin(kFar);
    if (step.lpNorm<Eigen::Infinity>() < kConverged) break;
  }
  return x;
}

struct Found {
  double distance;              // of the place from the element, m
  std::vector<double> weights;  // of the element's nodes
};

template <class Weights>
std::vector<double> as_list(const Weights& N) {
  return {N.data(), N.data() + N.size()};
}

Found in_tet(const Mesh& mesh, std::size_t cell, const Vec3& place) {
  const auto corners = mesh.cells.corners(cell);
  const Barycentric L = barycentric(mesh, corners, place), inside = clamped(L);
  Found found{0, {}};
  if (L.minCoeff() < 0) {
    Vec3 nearest = Vec3::Zero();
    for (std::size_t i = 0; i < 4; ++i) nearest += inside[static_cast<Eigen::Index>(i)] * mesh.node(corners[i]);
    found.distance = (nearest - place).norm();
  }
  found.weights = mesh.order() == 1 ? as_list(inside) : as_list(Tet10::shape(inside));
  return found;
}

// Distance of a place from a box around a cell, m. The box of the nodes is enlarged, because edges may bulge.
double distance_from_box(const Mesh& mesh, std::span<const int> nodes, const Vec3& place) {
  Vec3 low = mesh.node(nodes[0]), high = low;
  for (const int n : nodes) {
    low = low.cwiseMin(mesh.node(n));
    high = high.cwiseMax(mesh.node(n));
  }
  const Vec3 margin = Vec3::Constant(0.25 * (high - low).norm());
  return (place - place.cwiseMax(low - margin).cwiseMin(high + margin)).norm();
}

Found in_cell(const Mesh& mesh, std::size_t cell, const Vec3& place) {
  Found found{std::numeric_limits<double>::infinity(), {}};
  with_element(mesh.cells.shape(cell), [&]<class E>() {
    if constexpr (!std::is_same_v<E, Tet4> && !std::is_same_v<E, Tet10>) {
      const auto X = positions<E>(mesh, cell);
      const Vec3 x = natural<E>(X, place), inside = clamped<E>(x);
      const auto N = E::shape(inside);
      constexpr double kRoundOff = 1e-12;  // of natural coordinates
      const bool is_inside = (x - inside).lpNorm<Eigen::Infinity>() < kRoundOff;
      found = {is_inside && (X * N - place).norm() < kRoundOff * X.cwiseAbs().maxCoeff() ? 0 : (X * N - place).norm(),
               as_list(N)};
    } else {
      found = in_tet(mesh, cell, place);
    }
  });
  return found;
}

}  // namespace

MeshPoint mesh_point(const Mesh& mesh, const Vec3& place) {
  std::size_t best = 0;
  Found nearest = in_cell(mesh, 0, place);
  for (std::size_t c = 1; c < mesh.cells.size() && nearest.distance > 0; ++c) {
    if (mesh.cells.corners(c).size() > 4 && distance_from_box(mesh, mesh.cells[c], place) >= nearest.distance) continue;
    Found found = in_cell(mesh, c, place);
    if (found.distance < nearest.distance) best = c, nearest = std::move(found);
  }
  MeshPoint point;
  for (std::size_t a = 0; a < nearest.weights.size(); ++a)
    point.nodes.emplace_back(mesh.cells[best][a], nearest.weights[a]);
  return point;
}

}  // namespace orthodyn
