#include "lib/mesh/tet_mesh.h"

#include <cstddef>

#include "lib/core/errors.h"
#include "lib/mesh/tet_faces.h"

namespace orthodyn {

Box bounding_box(const TetMesh& mesh) {
  if (mesh.nodes.empty()) throw ConfigError("the mesh has no nodes");
  Box box{mesh.nodes.front(), mesh.nodes.front()};
  for (const Vec3& x : mesh.nodes) {
    box.min = box.min.cwiseMin(x);
    box.max = box.max.cwiseMax(x);
  }
  return box;
}

double signed_volume6(const TetMesh& mesh, const Tet& tet) {
  const auto node = [&](std::size_t i) -> const Vec3& {
    return mesh.nodes[static_cast<std::size_t>(tet[i])];
  };
  const Vec3 a = node(1) - node(0);
  const Vec3 b = node(2) - node(0);
  const Vec3 c = node(3) - node(0);
  return a.dot(b.cross(c));
}

std::vector<Triangle> boundary_triangles(const TetMesh& mesh) {
  const std::vector<TetFace> faces = sorted_faces(mesh);
  std::vector<Triangle> boundary;
  for (std::size_t begin = 0; begin < faces.size();) {
    const std::size_t end = end_of_face(faces, begin);
    if (end == begin + 1) boundary.push_back(faces[begin].outward());
    begin = end;
  }
  return boundary;
}

}  // namespace orthodyn
