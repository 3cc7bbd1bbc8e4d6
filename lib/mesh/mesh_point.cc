#include "lib/mesh/mesh_point.h"

#include <Eigen/LU>

#include "lib/element/tet10.h"

namespace orthodyn {

namespace {

using Barycentric = Tet10::Barycentric;

Barycentric barycentric(const TetMesh& mesh, const Tet& tet, const Vec3& place) {
  const auto corner = [&](std::size_t i) { return mesh.nodes[static_cast<std::size_t>(tet[i])]; };
  Mat3 edges;
  for (std::size_t i = 1; i < 4; ++i) edges.col(static_cast<Eigen::Index>(i) - 1) = corner(i) - corner(0);
  const Vec3 L = edges.inverse() * (place - corner(0));
  return {1 - L.sum(), L[0], L[1], L[2]};
}

// Barycentric coordinates of a nearby point within the element.
Barycentric clamped(const Barycentric& L) {
  const Barycentric inside = L.cwiseMax(0);
  return inside / inside.sum();
}

double distance_outside(const TetMesh& mesh, const Tet& tet, const Vec3& place, const Barycentric& L) {
  if (L.minCoeff() >= 0) return 0;
  const Barycentric inside = clamped(L);
  Vec3 nearest = Vec3::Zero();
  for (std::size_t i = 0; i < 4; ++i)
    nearest += inside[static_cast<Eigen::Index>(i)] * mesh.nodes[static_cast<std::size_t>(tet[i])];
  return (nearest - place).norm();
}

}  // namespace

MeshPoint mesh_point(const TetMesh& mesh, const Vec3& place) {
  std::size_t best = 0;
  Barycentric best_L = barycentric(mesh, mesh.tets[0], place);
  double best_distance = distance_outside(mesh, mesh.tets[0], place, best_L);
  for (std::size_t t = 1; t < mesh.tets.size() && best_distance > 0; ++t) {
    const Barycentric L = barycentric(mesh, mesh.tets[t], place);
    const double distance = distance_outside(mesh, mesh.tets[t], place, L);
    if (distance < best_distance) best = t, best_L = L, best_distance = distance;
  }
  const Barycentric L = clamped(best_L);
  MeshPoint point;
  if (mesh.order() == 1) {
    for (std::size_t i = 0; i < 4; ++i) point.nodes.emplace_back(mesh.tets[best][i], L[static_cast<Eigen::Index>(i)]);
    return point;
  }
  const Tet10::Values N = Tet10::shape(L);
  for (std::size_t i = 0; i < 4; ++i) point.nodes.emplace_back(mesh.tets[best][i], N[static_cast<Eigen::Index>(i)]);
  for (std::size_t e = 0; e < 6; ++e)
    point.nodes.emplace_back(mesh.midsides[best][e], N[static_cast<Eigen::Index>(e) + 4]);
  return point;
}

}  // namespace orthodyn
