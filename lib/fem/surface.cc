#include "lib/fem/surface.h"

#include <map>

namespace orthodyn {

namespace {

double area(const TetMesh& mesh, const Triangle& t) {
  const auto& x = [&](std::size_t k) -> const Vec3& { return mesh.nodes[static_cast<std::size_t>(t[k])]; };
  return 0.5 * (x(1) - x(0)).cross(x(2) - x(0)).norm();
}

}  // namespace

double surface_area(const TetMesh& mesh, const std::vector<Triangle>& triangles) {
  double sum = 0;
  for (const auto& t : triangles) sum += area(mesh, t);
  return sum;
}

NodalForces surface_forces(const TetMesh& mesh, const std::vector<Triangle>& triangles, const Vec3& traction) {
  std::map<int, Vec3> sums;
  for (const auto& t : triangles)
    for (const int node : t) sums.try_emplace(node, Vec3::Zero()).first->second += area(mesh, t) / 3 * traction;
  return {sums.begin(), sums.end()};
}

}  // namespace orthodyn
