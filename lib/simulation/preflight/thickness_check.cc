#include "lib/simulation/preflight/thickness_check.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>

namespace orthodyn {

namespace {

// Nodes of faces that belong to only one cell of the region.
std::vector<char> nodes_on_surface(const TetMesh& mesh, const std::vector<std::size_t>& cells) {
  std::map<Triangle, int> uses;
  const auto visit_faces = [&](const Tet& tet, auto&& visit) {
    for (std::size_t opposite = 0; opposite < 4; ++opposite) {
      Triangle face{};
      std::size_t k = 0;
      for (std::size_t a = 0; a < 4; ++a)
        if (a != opposite) face[k++] = tet[a];
      std::sort(face.begin(), face.end());
      visit(face);
    }
  };
  for (const std::size_t e : cells) visit_faces(mesh.tets[e], [&](const Triangle& face) { ++uses[face]; });
  std::vector<char> on_surface(mesh.nodes.size(), 0);
  for (const auto& [face, count] : uses)
    if (count == 1)
      for (const int node : face) on_surface[static_cast<std::size_t>(node)] = 1;
  return on_surface;
}

// Largest number of edges from a node of the region to its surface; 2 for two or more.
int depth(const TetMesh& mesh, const std::vector<std::size_t>& cells) {
  const std::vector<char> on_surface = nodes_on_surface(mesh, cells);
  std::vector<char> next_to_it(on_surface);
  bool is_deep = false;
  for (const std::size_t e : cells) {
    const auto touches = [&](int node) { return on_surface[static_cast<std::size_t>(node)] != 0; };
    const auto number = std::count_if(mesh.tets[e].begin(), mesh.tets[e].end(), touches);
    is_deep |= number < 4;
    if (number > 0)
      for (const int node : mesh.tets[e]) next_to_it[static_cast<std::size_t>(node)] = 1;
  }
  if (!is_deep) return 0;
  for (const std::size_t e : cells)
    for (const int node : mesh.tets[e])
      if (!next_to_it[static_cast<std::size_t>(node)]) return 2;
  return 1;
}

}  // namespace

std::vector<std::string> thin_regions(const TetMesh& mesh) {
  std::vector<std::string> out;
  if (mesh.order() > 1) return out;
  std::vector<std::vector<std::size_t>> cells(mesh.region_names.size());
  for (std::size_t e = 0; e < mesh.tets.size(); ++e) cells[static_cast<std::size_t>(mesh.region_of[e])].push_back(e);
  for (std::size_t r = 0; r < cells.size(); ++r) {
    if (cells[r].empty()) continue;
    const int deepest = depth(mesh, cells[r]);
    if (deepest > 1) continue;
    out.push_back(
        fmt::format("region {} is {} through its thickness: in bending and torsion its deflection may be less than "
                    "half of the true one; use mesh.order: 2",
                    mesh.region_names[r], deepest == 0 ? "one linear element" : "two or three linear elements"));
  }
  return out;
}

}  // namespace orthodyn
