#include "lib/mesh/split_cells.h"

#include <algorithm>
#include <set>

namespace orthodyn {

namespace {

std::size_t smallest_of(std::span<const int> nodes) {
  return static_cast<std::size_t>(std::min_element(nodes.begin(), nodes.end()) - nodes.begin());
}

bool all_differ(auto nodes) {
  std::sort(nodes.begin(), nodes.end());
  return std::adjacent_find(nodes.begin(), nodes.end()) == nodes.end();
}

// The triangles of a face, as local indices; a quadrilateral is cut by the diagonal through its smallest node.
std::vector<CornerIndices> cut(std::span<const int> face) {
  if (face.size() == 3) return {{0, 1, 2}};
  const std::size_t a = smallest_of(face), b = (a + 1) % 4, c = (a + 2) % 4, d = (a + 3) % 4;
  return {{a, b, c}, {a, c, d}};
}

bool has(const CornerIndices& places, std::size_t place) {
  return std::find(places.begin(), places.end(), place) != places.end();
}

// Whether corners with the same node are connected by edges, so that the element collapses to one with fewer corners.
bool collapses_along_edges(CellKind kind, std::span<const int> corners) {
  CornerIndices group(corners.size());
  for (std::size_t k = 0; k < group.size(); ++k) group[k] = k;
  for (const CornerIndices& face : faces_of(kind))
    for (std::size_t k = 0; k < face.size(); ++k) {
      const std::size_t a = face[k], b = face[(k + 1) % face.size()], from = group[a], to = group[b];
      if (corners[a] == corners[b]) std::replace(group.begin(), group.end(), from, to);
    }
  return std::set(group.begin(), group.end()).size() == std::set(corners.begin(), corners.end()).size();
}

// The triangles of the faces without this corner, as local indices, clockwise from outside.
std::vector<CornerIndices> triangles_away_from(std::size_t corner, CellKind kind, std::span<const int> corners) {
  std::vector<CornerIndices> triangles;
  for (const CornerIndices& face : faces_of(kind)) {
    if (has(face, corner)) continue;
    std::vector<int> nodes;
    for (const std::size_t k : face) nodes.push_back(corners[k]);
    for (const CornerIndices& t : cut(nodes)) triangles.push_back({face[t[0]], face[t[1]], face[t[2]]});
  }
  return triangles;
}

// Applies if no diagonal ends at the corner opposite to the smallest node. Two tets then replace the three at this
// corner: one of the corner and its three neighbours, and one of the smallest node and these neighbours. Removes the
// three triangles.
std::vector<CornerIndices> two_tets_of_three(std::size_t smallest, std::vector<CornerIndices>& triangles) {
  const std::size_t opposite = (smallest + 2) % 4 + (smallest < 4 ? 4 : 0);
  const auto at_opposite = [&](const CornerIndices& t) { return has(t, opposite); };
  if (std::count_if(triangles.begin(), triangles.end(), at_opposite) != 3) return {};
  const CornerIndices first = *std::find_if(triangles.begin(), triangles.end(), at_opposite);
  const auto k = static_cast<std::size_t>(std::find(first.begin(), first.end(), opposite) - first.begin());
  const std::size_t a = first[(k + 2) % 3], b = first[(k + 1) % 3];
  std::size_t c = 0;
  for (const CornerIndices& t : triangles)
    if (at_opposite(t))
      for (const std::size_t place : t)
        if (place != opposite && place != a && place != b) c = place;
  std::erase_if(triangles, at_opposite);
  return {{smallest, a, b, c}, {opposite, a, c, b}};
}

}  // namespace

const std::vector<CornerIndices>& faces_of(CellKind kind) {
  static const std::vector<CornerIndices> tet{{0, 1, 2}, {0, 3, 1}, {1, 3, 2}, {2, 3, 0}};
  static const std::vector<CornerIndices> pyramid{{0, 1, 2, 3}, {0, 4, 1}, {1, 4, 2}, {2, 4, 3}, {3, 4, 0}};
  static const std::vector<CornerIndices> wedge{{0, 1, 2}, {3, 5, 4}, {0, 3, 4, 1}, {1, 4, 5, 2}, {2, 5, 3, 0}};
  static const std::vector<CornerIndices> hexahedron{{0, 1, 2, 3}, {4, 7, 6, 5}, {0, 4, 5, 1},
                                                     {1, 5, 6, 2}, {2, 6, 7, 3}, {3, 7, 4, 0}};
  switch (kind) {
    case CellKind::tet: return tet;
    case CellKind::pyramid: return pyramid;
    case CellKind::wedge: return wedge;
    case CellKind::hexahedron: return hexahedron;
  }
  return tet;
}

const std::vector<std::array<std::size_t, 2>>& edges_of(CellKind kind) {
  using Edges = std::vector<std::array<std::size_t, 2>>;
  static const Edges none, pyramid{{0, 1}, {1, 2}, {2, 3}, {3, 0}, {0, 4}, {1, 4}, {2, 4}, {3, 4}};
  static const Edges wedge{{0, 1}, {1, 2}, {2, 0}, {3, 4}, {4, 5}, {5, 3}, {0, 3}, {1, 4}, {2, 5}};
  static const Edges hexahedron{{0, 1}, {1, 2}, {2, 3}, {3, 0}, {4, 5}, {5, 6},
                                {6, 7}, {7, 4}, {0, 4}, {1, 5}, {2, 6}, {3, 7}};
  switch (kind) {
    case CellKind::tet: return none;
    case CellKind::pyramid: return pyramid;
    case CellKind::wedge: return wedge;
    case CellKind::hexahedron: return hexahedron;
  }
  return none;
}

void append_triangles(std::span<const int> face, std::vector<FaceCorners>& triangles) {
  for (const CornerIndices& t : cut(face)) {
    const std::array triangle{face[t[0]], face[t[1]], face[t[2]]};
    if (face.size() == 3 || all_differ(triangle)) triangles.emplace_back(triangle[0], triangle[1], triangle[2]);
  }
}

// The smallest node is the apex of all tets; the triangles of the faces without it are the bases.
bool append_tets(CellKind kind, std::span<const int> corners, std::vector<Tet>& tets) {
  if (kind == CellKind::tet) {
    tets.push_back({corners[0], corners[1], corners[2], corners[3]});
    return true;
  }
  if (!collapses_along_edges(kind, corners)) return false;
  const std::size_t smallest = smallest_of(corners);
  std::vector<CornerIndices> triangles = triangles_away_from(smallest, kind, corners);
  std::vector<CornerIndices> cells;
  if (kind == CellKind::hexahedron) cells = two_tets_of_three(smallest, triangles);
  for (const CornerIndices& t : triangles) cells.push_back({smallest, t[0], t[2], t[1]});
  const std::size_t before = tets.size();
  for (const CornerIndices& c : cells) {
    const Tet tet{corners[c[0]], corners[c[1]], corners[c[2]], corners[c[3]]};
    if (all_differ(tet)) tets.push_back(tet);
  }
  return tets.size() > before;
}

}  // namespace orthodyn
