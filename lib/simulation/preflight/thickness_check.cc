#include "lib/simulation/preflight/thickness_check.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>

namespace orthodyn {

namespace {

// Nodes of faces that belong to only one cell of the region.
std::vector<char> nodes_on_surface(const Mesh& mesh, const std::vector<std::size_t>& cells) {
  Mesh region;
  region.nodes = mesh.nodes;
  for (const std::size_t e : cells) region.cells.add(mesh.cells.shape(e), mesh.cells[e]);
  std::vector<char> on_surface(mesh.nodes.size(), 0);
  for (const FaceCorners& face : boundary_faces(region))
    for (const int node : face) on_surface[static_cast<std::size_t>(node)] = 1;
  return on_surface;
}

// Largest number of edges from a node of the region to its surface; 2 for two or more.
int depth(const Mesh& mesh, const std::vector<std::size_t>& cells) {
  const std::vector<char> on_surface = nodes_on_surface(mesh, cells);
  std::vector<char> next_to_it(on_surface);
  bool is_deep = false;
  for (const std::size_t e : cells) {
    const auto touches = [&](int node) { return on_surface[static_cast<std::size_t>(node)] != 0; };
    const auto nodes = mesh.cells[e];
    const auto number = std::count_if(nodes.begin(), nodes.end(), touches);
    is_deep |= number < static_cast<std::ptrdiff_t>(nodes.size());
    if (number > 0)
      for (const int node : mesh.cells[e]) next_to_it[static_cast<std::size_t>(node)] = 1;
  }
  if (!is_deep) return 0;
  for (const std::size_t e : cells)
    for (const int node : mesh.cells[e])
      if (!next_to_it[static_cast<std::size_t>(node)]) return 2;
  return 1;
}

}  // namespace

std::vector<std::string> thin_regions(const FemModel::Parts& parts) {
  const Mesh& mesh = parts.mesh;
  std::set<std::string> deformable;
  for (const auto& term : parts.elastic) deformable.insert(term->definition().mesh_region);
  std::vector<std::string> out;
  if (mesh.order() > 1) return out;
  std::vector<std::vector<std::size_t>> cells(mesh.region_names.size());
  for (std::size_t e = 0; e < mesh.cells.size(); ++e) cells[static_cast<std::size_t>(mesh.region_of[e])].push_back(e);
  for (std::size_t r = 0; r < cells.size(); ++r) {
    if (cells[r].empty() || !deformable.contains(mesh.region_names[r])) continue;
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
