// validate(): one function per check.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <set>
#include <tuple>
#include <utility>

#include "lib/core/errors.h"
#include "lib/mesh/quadratic.h"
#include "lib/mesh/tet_faces.h"
#include "lib/mesh/tet_mesh.h"

namespace orthodyn {
namespace {

// Far above round-off (about 1e-16 for a flat tet), far below the thinnest legal sliver (about 1e-4 for a dihedral
// angle of 0.01 degree).
constexpr double kDegenerate = 1e-14;

const Vec3& node(const TetMesh& mesh, int index) { return mesh.nodes[static_cast<std::size_t>(index)]; }

int count(const auto& container) { return static_cast<int>(container.size()); }

template <class... Args>
[[noreturn]] void refuse(const std::string& place, fmt::format_string<Args...> message, Args&&... args) {
  throw ConfigError(place, fmt::format(message, std::forward<Args>(args)...));
}

void check_sizes(const TetMesh& mesh, const MeshOrigin& origin) {
  if (mesh.tets.empty()) refuse(origin.source, "the mesh has no solid elements");
  constexpr auto kMax = static_cast<std::size_t>(std::numeric_limits<int>::max());
  if (mesh.nodes.size() > kMax || mesh.tets.size() > kMax)
    refuse(origin.source, "{} nodes and {} elements; at most {} of each can be numbered", mesh.nodes.size(),
           mesh.tets.size(), kMax);
  if (mesh.region_of.size() != mesh.tets.size())
    refuse(origin.source, "{} elements but a region for {} of them", mesh.tets.size(), mesh.region_of.size());
  if (mesh.order() == 2 && mesh.midsides.size() != mesh.tets.size())
    refuse(origin.source, "{} of {} elements are quadratic; all must be of one order", mesh.midsides.size(),
           mesh.tets.size());
}

void check_indices(const TetMesh& mesh, const MeshOrigin& origin) {
  const auto check_node = [&](int n, const auto& name) {
    if (n >= 0 && n < count(mesh.nodes)) return;
    refuse(name(), "uses node {}, but there are {} nodes (0 to {})", n, mesh.nodes.size(), count(mesh.nodes) - 1);
  };
  for (int t = 0; t < count(mesh.tets); ++t) {
    const auto i = static_cast<std::size_t>(t);
    for (int n : mesh.tets[i]) check_node(n, [&] { return origin.tet(t); });
    if (mesh.order() == 2)
      for (int n : mesh.midsides[i]) check_node(n, [&] { return origin.tet(t); });
    if (mesh.region_of[i] < 0 || mesh.region_of[i] >= count(mesh.region_names))
      refuse(origin.tet(t), "in region {}, but there are {} regions", mesh.region_of[i], mesh.region_names.size());
  }
  for (const auto& [surface, triangles] : mesh.surfaces)
    for (int k = 0; k < count(triangles); ++k)
      for (int n : triangles[static_cast<std::size_t>(k)])
        check_node(n, [&, &name = surface] { return origin.triangle(name, k); });
  for (const auto& [set, nodes] : mesh.node_sets)
    for (int n : nodes)
      check_node(n, [&, &name = set] { return fmt::format("{}: node set \"{}\"", origin.source, name); });
}

void check_coordinates(const TetMesh& mesh, const MeshOrigin& origin) {
  for (int n = 0; n < count(mesh.nodes); ++n) {
    const Vec3& x = node(mesh, n);
    if (x.allFinite()) continue;
    refuse(origin.node(n), "coordinates ({}, {}, {}) are not finite", x[0], x[1], x[2]);
  }
}

std::vector<char> used_nodes(const TetMesh& mesh) {
  std::vector<char> used(mesh.nodes.size(), 0);
  for (const Tet& tet : mesh.tets)
    for (int n : tet) used[static_cast<std::size_t>(n)] = 1;
  for (const Midsides& middles : mesh.midsides)
    for (int n : middles) used[static_cast<std::size_t>(n)] = 1;
  return used;
}

void check_coincident_nodes(const TetMesh& mesh, const std::vector<char>& used, const MeshOrigin& origin) {
  struct Place {
    double x, y, z;
    int node;
  };
  std::vector<Place> places;
  for (int n = 0; n < count(mesh.nodes); ++n) {
    const Vec3& x = node(mesh, n);
    if (used[static_cast<std::size_t>(n)]) places.push_back({x[0], x[1], x[2], n});
  }
  std::sort(places.begin(), places.end(), [](const Place& a, const Place& b) {
    return std::tie(a.x, a.y, a.z, a.node) < std::tie(b.x, b.y, b.z, b.node);
  });
  const auto same = std::adjacent_find(places.begin(), places.end(), [](const Place& a, const Place& b) {
    return std::tie(a.x, a.y, a.z) == std::tie(b.x, b.y, b.z);
  });
  if (same == places.end()) return;
  const auto other = same + 1;
  refuse(origin.node(other->node),
         "at exactly the same place ({}, {}, {}) as {}; elements that only touch there are not connected: merge the "
         "two nodes (Gmsh: \"Coherence\" before meshing, \"Coherence Mesh\" after)",
         other->x, other->y, other->z, origin.node(same->node));
}

// The shape of a tet. Edges are scaled by the largest coordinate difference, so that tiny and huge meshes neither over-
// nor underflow.
struct TetShape {
  double longest_edge;  // m
  double ratio;         // 6 signed volume / longest edge^3; NaN if all nodes coincide
};

TetShape shape_of(const TetMesh& mesh, const Tet& tet) {
  Mat3 edges;
  for (int i = 0; i < 3; ++i) edges.col(i) = node(mesh, tet[static_cast<std::size_t>(i) + 1]) - node(mesh, tet[0]);
  const double scale = edges.cwiseAbs().maxCoeff();
  edges /= scale;
  double longest = 0;
  for (int i = 0; i < 3; ++i)
    longest = std::max({longest, edges.col(i).norm(), (edges.col(i) - edges.col((i + 1) % 3)).norm()});
  const double volume6 = edges.col(0).dot(edges.col(1).cross(edges.col(2)));
  return {scale * longest, volume6 / (longest * longest * longest)};
}

[[noreturn]] void refuse_inverted(const TetMesh& mesh, int first, const MeshOrigin& origin) {
  int inverted = 0;
  for (const Tet& tet : mesh.tets) inverted += shape_of(mesh, tet).ratio < -kDegenerate;
  const std::string more =
      inverted == 1 ? "" : fmt::format("; {} of {} elements are inverted", inverted, mesh.tets.size());
  refuse(origin.tet(first), "inverted (volume {:.3g} m^3); reorder two of its nodes or remesh{}",
         signed_volume6(mesh, mesh.tets[static_cast<std::size_t>(first)]) / 6, more);
}

void check_volumes(const TetMesh& mesh, const MeshOrigin& origin) {
  for (int t = 0; t < count(mesh.tets); ++t) {
    const Tet& tet = mesh.tets[static_cast<std::size_t>(t)];
    const TetShape shape = shape_of(mesh, tet);
    if (!(std::abs(shape.ratio) >= kDegenerate)) {  // also refuses NaN
      refuse(origin.tet(t), "degenerate (volume {:.3g} m^3, longest edge {:.3g} m); remesh, or move its nodes apart",
             signed_volume6(mesh, tet) / 6, shape.longest_edge);
    }
    if (shape.ratio < 0) refuse_inverted(mesh, t, origin);
    if (!std::isnormal(signed_volume6(mesh, tet) / 6))
      refuse(origin.tet(t),
             "its volume cannot be represented (longest edge {:.3g} m); check the unit of length, metres are expected",
             shape.longest_edge);
  }
}

[[noreturn]] void refuse_overlap(const TetMesh& mesh, int a, int b, const MeshOrigin& origin) {
  Tet first = mesh.tets[static_cast<std::size_t>(a)];
  Tet second = mesh.tets[static_cast<std::size_t>(b)];
  std::sort(first.begin(), first.end());
  std::sort(second.begin(), second.end());
  if (first == second)
    refuse(origin.tet(b),
           "the same nodes as {}; an element belongs to one region: remove one of the two (Gmsh: a volume in two "
           "physical volumes?)",
           origin.tet(a));
  refuse(origin.tet(b), "overlaps {} (both lie on the same side of a common face); remesh", origin.tet(a));
}

void check_overlaps(const TetMesh& mesh, const std::vector<TetFace>& faces, const MeshOrigin& origin) {
  int first = -1;  // the first element that overlaps an earlier one
  int earlier = -1;
  for (std::size_t f = 1; f < faces.size(); ++f) {
    const bool same_side = faces[f].nodes == faces[f - 1].nodes && faces[f].flipped == faces[f - 1].flipped;
    if (!same_side || (first >= 0 && faces[f].tet >= first)) continue;
    first = faces[f].tet;
    earlier = faces[f - 1].tet;
  }
  if (first >= 0) refuse_overlap(mesh, earlier, first, origin);
}

// The first face with these (ascending) nodes, or faces.size().
std::size_t find_face(const std::vector<TetFace>& faces, const Triangle& nodes) {
  const auto before = [](const TetFace& face, const Triangle& key) { return face.nodes < key; };
  const auto found = std::lower_bound(faces.begin(), faces.end(), nodes, before);
  return found == faces.end() || found->nodes != nodes ? faces.size() : static_cast<std::size_t>(found - faces.begin());
}

void clean_surface(const std::string& surface, std::vector<Triangle>& triangles, const std::vector<TetFace>& faces,
                   const MeshOrigin& origin, Warnings& warnings) {
  std::set<std::size_t> seen;
  std::vector<Triangle> kept;
  for (int k = 0; k < count(triangles); ++k) {
    const Triangle& triangle = triangles[static_cast<std::size_t>(k)];
    Triangle key = triangle;
    sort_nodes(key);
    const std::size_t face = find_face(faces, key);
    if (face == faces.size())
      refuse(origin.triangle(surface, k),
             "surface \"{}\": not a face of any element; is the volume behind this surface part of the mesh?", surface);
    if (!seen.insert(face).second) continue;
    const bool outer = end_of_face(faces, face) == face + 1;
    kept.push_back(outer ? faces[face].outward() : triangle);
  }
  if (kept.size() != triangles.size())
    warnings.push_back(fmt::format("{}: surface \"{}\": {} of {} triangles repeat an earlier one; each counts once",
                                   origin.source, surface, triangles.size() - kept.size(), triangles.size()));
  triangles = std::move(kept);
}

void remove_unused_nodes(TetMesh& mesh, const std::vector<char>& used, const MeshOrigin& origin, Warnings& warnings) {
  const auto unused = std::count(used.begin(), used.end(), 0);
  if (unused == 0) return;
  const auto first = std::find(used.begin(), used.end(), 0) - used.begin();
  warnings.push_back(fmt::format("{}: removed {} node{} that no element uses (first: {})", origin.source, unused,
                                 unused == 1 ? "" : "s", origin.node(static_cast<int>(first))));
  std::vector<char> marked(used.size());
  std::transform(used.begin(), used.end(), marked.begin(), [](char is_used) { return is_used ? 0 : 1; });
  remove_nodes(mesh, marked);
}

void sort_node_sets(TetMesh& mesh) {
  for (auto& [set, nodes] : mesh.node_sets) {
    std::sort(nodes.begin(), nodes.end());
    nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
  }
}

}  // namespace

Warnings validate(TetMesh& mesh, const MeshOrigin& origin) {
  check_sizes(mesh, origin);
  check_indices(mesh, origin);
  check_coordinates(mesh, origin);
  const std::vector<char> used = used_nodes(mesh);
  check_coincident_nodes(mesh, used, origin);
  check_volumes(mesh, origin);
  if (mesh.order() == 2) validate_quadratic(mesh, origin);
  const std::vector<TetFace> faces = sorted_faces(mesh);
  check_overlaps(mesh, faces, origin);

  Warnings warnings;
  for (auto& [surface, triangles] : mesh.surfaces) clean_surface(surface, triangles, faces, origin, warnings);
  sort_node_sets(mesh);
  remove_unused_nodes(mesh, used, origin, warnings);
  return warnings;
}

}  // namespace orthodyn
