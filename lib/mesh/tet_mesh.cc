#include "lib/mesh/tet_mesh.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <utility>

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
  const auto node = [&](std::size_t i) -> const Vec3& { return mesh.nodes[static_cast<std::size_t>(tet[i])]; };
  const Vec3 a = node(1) - node(0);
  const Vec3 b = node(2) - node(0);
  const Vec3 c = node(3) - node(0);
  return a.dot(b.cross(c));
}

Vec3 centroid(const TetMesh& mesh, int tet) {
  Vec3 sum = Vec3::Zero();
  for (const int node : mesh.tets[static_cast<std::size_t>(tet)]) sum += mesh.nodes[static_cast<std::size_t>(node)];
  return sum / 4;
}

std::string MeshOrigin::tet(int index) const {
  return tet_name ? tet_name(index) : fmt::format("{}: element {}", source, index);
}

std::string MeshOrigin::node(int index) const {
  return node_name ? node_name(index) : fmt::format("{}: node {}", source, index);
}

std::string MeshOrigin::triangle(const std::string& surface, int index) const {
  return triangle_name ? triangle_name(surface, index) : fmt::format("{}: triangle {}", source, index);
}

void remove_nodes(TetMesh& mesh, const std::vector<char>& marked) {
  std::vector<int> new_index(mesh.nodes.size(), -1);
  std::vector<Vec3> kept;
  for (std::size_t n = 0; n < marked.size(); ++n) {
    if (marked[n]) continue;
    new_index[n] = static_cast<int>(kept.size());
    kept.push_back(mesh.nodes[n]);
  }
  mesh.nodes = std::move(kept);
  const auto renumber = [&](int& n) { n = new_index[static_cast<std::size_t>(n)]; };
  for (Tet& tet : mesh.tets) std::for_each(tet.begin(), tet.end(), renumber);
  for (Midsides& middles : mesh.midsides) std::for_each(middles.begin(), middles.end(), renumber);
  for (auto& [surface, triangles] : mesh.surfaces)
    for (Triangle& t : triangles) std::for_each(t.begin(), t.end(), renumber);
  for (auto& [set, nodes] : mesh.node_sets) {
    std::erase_if(nodes, [&](int n) { return marked[static_cast<std::size_t>(n)] != 0; });
    std::for_each(nodes.begin(), nodes.end(), renumber);
  }
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
