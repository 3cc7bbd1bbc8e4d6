#include "lib/mesh/whole_cells.h"

#include <algorithm>
#include <array>
#include <map>
#include <mutex>
#include <set>

namespace orthodyn {

namespace {

bool is_collapsed(const FileCell& cell) {
  const auto corners = cell.corners();
  return std::set(corners.begin(), corners.end()).size() < corners.size();
}

CellShape linear_shape(CellKind kind) {
  switch (kind) {
    case CellKind::wedge: return CellShape::wedge6;
    case CellKind::hexahedron: return CellShape::hex8;
    default: return CellShape::tet4;
  }
}

// The node in the middle of these corners (places in the cell), if the file has one.
std::optional<std::int64_t> middle_of(const FileCell& cell, const std::vector<int>& corners) {
  const auto tag = [&](std::size_t k) { return cell.nodes[static_cast<std::size_t>(corners[k])]; };
  // The ends of the edge or of a diagonal; corners 0 and 6 of a hexahedron are opposite.
  const std::int64_t a = tag(0), b = corners.size() == 2 ? tag(1) : corners.size() == 4 ? tag(2) : tag(6);
  for (const FileEdge& edge : cell.edges)
    if ((edge.a == a && edge.b == b) || (edge.a == b && edge.b == a)) return edge.middle;
  return std::nullopt;
}

// The nodes of a cell of this shape; empty if the file lacks one of them.
std::vector<std::int64_t> nodes_of(const FileCell& cell, CellShape shape) {
  std::vector<std::int64_t> nodes(cell.corners().begin(), cell.corners().end());
  for (const std::vector<int>& corners : topology(shape).middles) {
    const auto middle = middle_of(cell, corners);
    if (!middle) return {};
    nodes.push_back(*middle);
  }
  return nodes;
}

// The two quadratic shapes of a wedge or hexahedron: the one with nodes on edges, faces and at the centre, then the one
// with nodes on edges only.
std::array<CellShape, 2> quadratic_shapes(CellKind kind) {
  if (kind == CellKind::wedge) return {CellShape::wedge18, CellShape::wedge15};
  return {CellShape::hex27, CellShape::hex20};
}

// For each node of a cell, the node that takes its place if the cell is turned: tetrahedra exchange two corners, wedges
// and hexahedra their two ends.
std::vector<std::size_t> turned_places(const CellTopology& cell) {
  std::vector<int> corner;
  for (int k = 0; k < cell.corners; ++k)
    corner.push_back(cell.corners == 4 ? (k < 2 ? k : 5 - k) : (k + cell.corners / 2) % cell.corners);
  std::vector<std::size_t> places(corner.begin(), corner.end());
  for (const std::vector<int>& middle : cell.middles) {
    std::set<int> moved;
    for (const int k : middle) moved.insert(corner[static_cast<std::size_t>(k)]);
    for (std::size_t other = 0; other < cell.middles.size(); ++other)
      if (std::set<int>(cell.middles[other].begin(), cell.middles[other].end()) == moved)
        places.push_back(static_cast<std::size_t>(cell.corners) + other);
  }
  return places;
}

}  // namespace

bool can_keep_cells(const MeshDraft& draft, FileCells cells) {
  if (cells == FileCells::split) return false;
  return std::all_of(draft.cells.begin(), draft.cells.end(), [&](const FileCell& cell) {
    if (cell.kind == CellKind::tet) return true;
    if (cell.kind == CellKind::pyramid || is_collapsed(cell)) return false;
    if (!cell.is_quadratic()) return true;
    return !nodes_of(cell, quadratic_shapes(cell.kind)[1]).empty();
  });
}

WholeCell whole_cell(const FileCell& cell) {
  const auto corners = cell.corners();
  if (!cell.is_quadratic()) return {linear_shape(cell.kind), {corners.begin(), corners.end()}};
  if (cell.kind == CellKind::tet) {
    WholeCell out{CellShape::tet10, {corners.begin(), corners.end()}};
    out.nodes.insert(out.nodes.end(), cell.midsides->begin(), cell.midsides->end());
    return out;
  }
  const auto [full, edges_only] = quadratic_shapes(cell.kind);
  std::vector<std::int64_t> nodes = nodes_of(cell, full);
  if (!nodes.empty()) return {full, std::move(nodes)};
  return {edges_only, nodes_of(cell, edges_only)};
}

void turn_cell(CellShape shape, std::span<int> nodes) {
  static std::map<CellShape, std::vector<std::size_t>> known;
  static std::mutex adding;
  const std::lock_guard lock(adding);
  std::vector<std::size_t>& places = known[shape];
  if (places.empty()) places = turned_places(topology(shape));
  std::array<int, 27> before{};
  std::copy(nodes.begin(), nodes.end(), before.begin());
  for (std::size_t k = 0; k < nodes.size(); ++k) nodes[k] = before[places[k]];
}

}  // namespace orthodyn
