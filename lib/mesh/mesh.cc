#include "lib/mesh/mesh.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <utility>

#include "lib/core/errors.h"
#include "lib/core/spelling.h"
#include "lib/mesh/mesh_faces.h"

namespace orthodyn {

Box bounding_box(const Mesh& mesh) {
  if (mesh.nodes.empty()) throw ConfigError("the mesh has no nodes");
  Box box{mesh.nodes.front(), mesh.nodes.front()};
  for (const Vec3& x : mesh.nodes) {
    box.min = box.min.cwiseMin(x);
    box.max = box.max.cwiseMax(x);
  }
  return box;
}

double signed_volume6(const Mesh& mesh, const Tet& tet) {
  const auto node = [&](std::size_t i) -> const Vec3& { return mesh.nodes[static_cast<std::size_t>(tet[i])]; };
  const Vec3 a = node(1) - node(0);
  const Vec3 b = node(2) - node(0);
  const Vec3 c = node(3) - node(0);
  return a.dot(b.cross(c));
}

bool Mesh::has_tets_only() const {
  return std::all_of(cells.shapes().begin(), cells.shapes().end(),
                     [](CellShape shape) { return topology(shape).corners == 4; });
}

Vec3 centroid(const Mesh& mesh, int cell) {
  const auto corners = mesh.cells.corners(static_cast<std::size_t>(cell));
  Vec3 sum = Vec3::Zero();
  for (const int node : corners) sum += mesh.node(node);
  return sum / static_cast<double>(corners.size());
}

std::string describe_cells(const Cells& cells) {
  std::map<CellShape, std::size_t> counts;
  for (const CellShape shape : cells.shapes()) ++counts[shape];
  std::vector<std::string> parts;
  for (const auto& [shape, count] : counts)
    parts.push_back(fmt::format("{} {}", count, count == 1 ? topology(shape).name : topology(shape).plural));
  if (parts.empty()) return "no cells";
  const std::string last = parts.back();
  parts.pop_back();
  return parts.empty() ? last : join(parts) + " and " + last;
}

std::string MeshOrigin::cell(int index) const {
  return cell_name ? cell_name(index) : fmt::format("{}: element {}", source, index);
}

std::string MeshOrigin::node(int index) const {
  return node_name ? node_name(index) : fmt::format("{}: node {}", source, index);
}

std::string MeshOrigin::face(const std::string& surface, int index) const {
  return face_name ? face_name(surface, index) : fmt::format("{}: face {}", source, index);
}

void remove_nodes(Mesh& mesh, const std::vector<char>& marked) {
  std::vector<int> new_index(mesh.nodes.size(), -1);
  std::vector<Vec3> kept;
  for (std::size_t n = 0; n < marked.size(); ++n) {
    if (marked[n]) continue;
    new_index[n] = static_cast<int>(kept.size());
    kept.push_back(mesh.nodes[n]);
  }
  mesh.nodes = std::move(kept);
  const auto renumber = [&](int& n) { n = new_index[static_cast<std::size_t>(n)]; };
  std::for_each(mesh.cells.nodes().begin(), mesh.cells.nodes().end(), renumber);
  for (auto& [surface, faces] : mesh.surfaces)
    for (FaceCorners& face : faces) std::for_each(face.begin(), face.end(), renumber);
  for (auto& [set, nodes] : mesh.node_sets) {
    std::erase_if(nodes, [&](int n) { return marked[static_cast<std::size_t>(n)] != 0; });
    std::for_each(nodes.begin(), nodes.end(), renumber);
  }
}

std::vector<FaceCorners> boundary_faces(const Mesh& mesh) {
  const std::vector<MeshFace> faces = sorted_faces(mesh);
  std::vector<FaceCorners> boundary;
  for (std::size_t begin = 0; begin < faces.size();) {
    const std::size_t end = end_of_face(faces, begin);
    if (end == begin + 1) boundary.push_back(faces[begin].outward());
    begin = end;
  }
  return boundary;
}

}  // namespace orthodyn
