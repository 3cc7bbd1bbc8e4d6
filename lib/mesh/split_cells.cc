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

// The places in a face that its triangles have: two of a quadrilateral, by the diagonal through the smallest node.
std::vector<Places> cut(std::span<const int> face) {
  if (face.size() == 3) return {{0, 1, 2}};
  const std::size_t a = smallest_of(face), b = (a + 1) % 4, c = (a + 2) % 4, d = (a + 3) % 4;
  return {{a, b, c}, {a, c, d}};
}

bool has(const Places& places, std::size_t place) {
  return std::find(places.begin(), places.end(), place) != places.end();
}

// Whether corners with the same node are neighbours along edges, so that the element is one with fewer corners.
bool collapses_along_edges(CellKind kind, std::span<const int> corners) {
  Places group(corners.size());
  for (std::size_t k = 0; k < group.size(); ++k) group[k] = k;
  for (const Places& face : faces_of(kind))
    for (std::size_t k = 0; k < face.size(); ++k) {
      const std::size_t a = face[k], b = face[(k + 1) % face.size()], from = group[a], to = group[b];
      if (corners[a] == corners[b]) std::replace(group.begin(), group.end(), from, to);
    }
  return std::set(group.begin(), group.end()).size() == std::set(corners.begin(), corners.end()).size();
}

// The triangles, by places of corners and clockwise from outside, of the faces that do not have this corner.
std::vector<Places> triangles_away_from(std::size_t corner, CellKind kind, std::span<const int> corners) {
  std::vector<Places> triangles;
  for (const Places& face : faces_of(kind)) {
    if (has(face, corner)) continue;
    std::vector<int> nodes;
    for (const std::size_t k : face) nodes.push_back(corners[k]);
    for (const Places& t : cut(nodes)) triangles.push_back({face[t[0]], face[t[1]], face[t[2]]});
  }
  return triangles;
}

// Where no diagonal ends at the corner opposite to the smallest node, the three tets there are two: one of this corner
// and its three neighbours, one of the smallest node and these. Takes the three triangles away.
std::vector<Places> two_tets_of_three(std::size_t smallest, std::vector<Places>& triangles) {
  const std::size_t opposite = (smallest + 2) % 4 + (smallest < 4 ? 4 : 0);
  const auto at_opposite = [&](const Places& t) { return has(t, opposite); };
  if (std::count_if(triangles.begin(), triangles.end(), at_opposite) != 3) return {};
  const Places first = *std::find_if(triangles.begin(), triangles.end(), at_opposite);
  const auto k = static_cast<std::size_t>(std::find(first.begin(), first.end(), opposite) - first.begin());
  const std::size_t a = first[(k + 2) % 3], b = first[(k + 1) % 3];
  std::size_t c = 0;
  for (const Places& t : triangles)
    if (at_opposite(t))
      for (const std::size_t place : t)
        if (place != opposite && place != a && place != b) c = place;
  std::erase_if(triangles, at_opposite);
  return {{smallest, a, b, c}, {opposite, a, c, b}};
}

}  // namespace

const std::vector<Places>& faces_of(CellKind kind) {
  static const std::vector<Places> tet{{0, 1, 2}, {0, 3, 1}, {1, 3, 2}, {2, 3, 0}};
  static const std::vector<Places> pyramid{{0, 1, 2, 3}, {0, 4, 1}, {1, 4, 2}, {2, 4, 3}, {3, 4, 0}};
  static const std::vector<Places> wedge{{0, 1, 2}, {3, 5, 4}, {0, 3, 4, 1}, {1, 4, 5, 2}, {2, 5, 3, 0}};
  static const std::vector<Places> hexahedron{{0, 1, 2, 3}, {4, 7, 6, 5}, {0, 4, 5, 1},
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

void append_triangles(std::span<const int> face, std::vector<Triangle>& triangles) {
  for (const Places& t : cut(face)) {
    const Triangle triangle{face[t[0]], face[t[1]], face[t[2]]};
    if (face.size() == 3 || all_differ(triangle)) triangles.push_back(triangle);
  }
}

// All tets have the smallest node: faces with it are cut by diagonals through it, and the others, each cut by its own
// diagonal, are the bases.
bool append_tets(CellKind kind, std::span<const int> corners, std::vector<Tet>& tets) {
  if (kind == CellKind::tet) {
    tets.push_back({corners[0], corners[1], corners[2], corners[3]});
    return true;
  }
  if (!collapses_along_edges(kind, corners)) return false;
  const std::size_t smallest = smallest_of(corners);
  std::vector<Places> triangles = triangles_away_from(smallest, kind, corners);
  std::vector<Places> cells;
  if (kind == CellKind::hexahedron) cells = two_tets_of_three(smallest, triangles);
  for (const Places& t : triangles) cells.push_back({smallest, t[0], t[2], t[1]});
  const std::size_t before = tets.size();
  for (const Places& c : cells) {
    const Tet tet{corners[c[0]], corners[c[1]], corners[c[2]], corners[c[3]]};
    if (all_differ(tet)) tets.push_back(tet);
  }
  return tets.size() > before;
}

}  // namespace orthodyn
