#include "lib/fem/surface.h"

#include <map>

#include "lib/element/tri3.h"

namespace orthodyn {

namespace {

Tri3::Nodes nodes_of(const TetMesh& mesh, const Triangle& triangle) {
  Tri3::Nodes X;
  for (std::size_t a = 0; a < triangle.size(); ++a)
    X.col(static_cast<Eigen::Index>(a)) = mesh.nodes[static_cast<std::size_t>(triangle[a])];
  return X;
}

}  // namespace

double surface_area(const TetMesh& mesh, const std::vector<Triangle>& triangles) {
  double sum = 0;
  for (const auto& t : triangles) sum += Tri3::area(nodes_of(mesh, t));
  return sum;
}

NodalForces surface_forces(const TetMesh& mesh, const std::vector<Triangle>& triangles, const Vec3& traction) {
  std::map<int, Vec3> sums;
  for (const auto& t : triangles) {
    const auto areas = Tri3::node_areas(nodes_of(mesh, t));
    for (std::size_t a = 0; a < t.size(); ++a)
      sums.try_emplace(t[a], Vec3::Zero()).first->second += areas[a] * traction;
  }
  return {sums.begin(), sums.end()};
}

NodalForces surface_forces(const TetMesh& mesh, const std::vector<Triangle>& triangles,
                           const std::array<PointQuantity, 3>& traction) {
  std::map<int, Vec3> sums;
  for (const auto& t : triangles) {
    const double area = Tri3::area(nodes_of(mesh, t));
    Mat3 means;  // a row for each component
    for (std::size_t c = 0; c < 3; ++c) means.row(static_cast<Eigen::Index>(c)) = node_means(mesh, t, traction[c]);
    for (std::size_t a = 0; a < t.size(); ++a)
      sums.try_emplace(t[a], Vec3::Zero()).first->second += area * means.col(static_cast<Eigen::Index>(a));
  }
  return {sums.begin(), sums.end()};
}

Vec3 node_means(const TetMesh& mesh, const Triangle& triangle, const PointQuantity& g) {
  if (g.uniform()) return Vec3::Constant(g.at(Vec3::Zero()) / 3);
  return Tri3::node_means(nodes_of(mesh, triangle), [&](const Vec3& x) { return g.at(x); });
}

}  // namespace orthodyn
