// validate(): one function per check.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <set>
#include <span>
#include <tuple>
#include <utility>

#include "lib/core/errors.h"
#include "lib/mesh/folded_cells.h"
#include "lib/mesh/mesh.h"
#include "lib/mesh/mesh_faces.h"
#include "lib/mesh/quadratic.h"

namespace orthodyn {
namespace {

// Far above round-off (about 1e-16 for a flat tet), far below the thinnest legal sliver (about 1e-4 for a dihedral
// angle of 0.01 degree).
constexpr double kDegenerate = 1e-14;

const Vec3& node(const Mesh& mesh, int index) { return mesh.nodes[static_cast<std::size_t>(index)]; }

int count(const auto& container) { return static_cast<int>(container.size()); }

template <class... Args>
[[noreturn]] void refuse(const std::string& place, fmt::format_string<Args...> message, Args&&... args) {
  throw ConfigError(place, fmt::format(message, std::forward<Args>(args)...));
}

void check_sizes(const Mesh& mesh, const MeshOrigin& origin) {
  if (mesh.cells.empty()) refuse(origin.source, "the mesh has no solid elements");
  constexpr auto kMax = static_cast<std::size_t>(std::numeric_limits<int>::max());
  if (mesh.nodes.size() > kMax || mesh.cells.size() > kMax)
    refuse(origin.source, "{} nodes and {} elements; at most {} of each can be numbered", mesh.nodes.size(),
           mesh.cells.size(), kMax);
  if (mesh.region_of.size() != mesh.cells.size())
    refuse(origin.source, "{} elements but a region for {} of them", mesh.cells.size(), mesh.region_of.size());
  const auto quadratic = std::count_if(mesh.cells.shapes().begin(), mesh.cells.shapes().end(),
                                       [](CellShape shape) { return topology(shape).order == 2; });
  if (quadratic > 0 && quadratic < count(mesh.cells))
    refuse(origin.source, "{} of {} elements are quadratic; all must be of one order", quadratic, mesh.cells.size());
}

void check_indices(const Mesh& mesh, const MeshOrigin& origin) {
  const auto check_node = [&](int n, const auto& name) {
    if (n >= 0 && n < count(mesh.nodes)) return;
    refuse(name(), "uses node {}, but there are {} nodes (0 to {})", n, mesh.nodes.size(), count(mesh.nodes) - 1);
  };
  for (int c = 0; c < count(mesh.cells); ++c) {
    const auto i = static_cast<std::size_t>(c);
    for (int n : mesh.cells[i]) check_node(n, [&] { return origin.cell(c); });
    if (mesh.region_of[i] < 0 || mesh.region_of[i] >= count(mesh.region_names))
      refuse(origin.cell(c), "in region {}, but there are {} regions", mesh.region_of[i], mesh.region_names.size());
  }
  for (const auto& [surface, faces] : mesh.surfaces)
    for (int k = 0; k < count(faces); ++k)
      for (int n : faces[static_cast<std::size_t>(k)])
        check_node(n, [&, &name = surface] { return origin.face(name, k); });
  for (const auto& [set, nodes] : mesh.node_sets)
    for (int n : nodes)
      check_node(n, [&, &name = set] { return fmt::format("{}: node set \"{}\"", origin.source, name); });
}

void check_coordinates(const Mesh& mesh, const MeshOrigin& origin) {
  for (int n = 0; n < count(mesh.nodes); ++n) {
    const Vec3& x = node(mesh, n);
    if (x.allFinite()) continue;
    refuse(origin.node(n), "coordinates ({}, {}, {}) are not finite", x[0], x[1], x[2]);
  }
}

std::vector<char> used_nodes(const Mesh& mesh) {
  std::vector<char> used(mesh.nodes.size(), 0);
  for (const int n : mesh.cells.nodes()) used[static_cast<std::size_t>(n)] = 1;
  return used;
}

void check_coincident_nodes(const Mesh& mesh, const std::vector<char>& used, const MeshOrigin& origin) {
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

// The shape of a cell by its corners. Edges are scaled by the largest coordinate difference, so that tiny and huge
// meshes neither over- nor underflow.
struct ShapeOfCell {
  double longest_edge;  // m
  double volume;        // signed, m^3
  double ratio;         // 6 volume / longest edge^3; NaN if all nodes coincide
};

ShapeOfCell shape_of_tet(const Mesh& mesh, std::span<const int> tet) {
  Mat3 edges;
  for (int i = 0; i < 3; ++i) edges.col(i) = node(mesh, tet[static_cast<std::size_t>(i) + 1]) - node(mesh, tet[0]);
  const double scale = edges.cwiseAbs().maxCoeff();
  edges /= scale;
  double longest = 0;
  for (int i = 0; i < 3; ++i)
    longest = std::max({longest, edges.col(i).norm(), (edges.col(i) - edges.col((i + 1) % 3)).norm()});
  const double volume6 = edges.col(0).dot(edges.col(1).cross(edges.col(2)));
  return {scale * longest, signed_volume6(mesh, {tet[0], tet[1], tet[2], tet[3]}) / 6,
          volume6 / (longest * longest * longest)};
}

ShapeOfCell shape_of(const Mesh& mesh, std::size_t cell) {
  const auto corners = mesh.cells.corners(cell);
  if (corners.size() == 4) return shape_of_tet(mesh, corners);
  double longest = 0;
  for (const int a : corners)
    for (const int b : corners) longest = std::max(longest, (node(mesh, a) - node(mesh, b)).stableNorm());
  const double volume = cell_volume(mesh, cell), scaled = std::cbrt(std::abs(volume)) / longest;
  return {longest, volume, std::copysign(6 * scaled * scaled * scaled, volume)};
}

[[noreturn]] void refuse_inverted(const Mesh& mesh, int first, const MeshOrigin& origin) {
  int inverted = 0;
  for (std::size_t c = 0; c < mesh.cells.size(); ++c) inverted += shape_of(mesh, c).ratio < -kDegenerate;
  const std::string more =
      inverted == 1 ? "" : fmt::format("; {} of {} elements are inverted", inverted, mesh.cells.size());
  refuse(origin.cell(first), "inverted (volume {:.3g} m^3); reorder two of its nodes or remesh{}",
         shape_of(mesh, static_cast<std::size_t>(first)).volume, more);
}

void check_volumes(const Mesh& mesh, const MeshOrigin& origin) {
  for (int c = 0; c < count(mesh.cells); ++c) {
    const ShapeOfCell shape = shape_of(mesh, static_cast<std::size_t>(c));
    if (!(std::abs(shape.ratio) >= kDegenerate)) {  // also refuses NaN
      refuse(origin.cell(c), "degenerate (volume {:.3g} m^3, longest edge {:.3g} m); remesh, or move its nodes apart",
             shape.volume, shape.longest_edge);
    }
    if (shape.ratio < 0) refuse_inverted(mesh, c, origin);
    if (!std::isnormal(shape.volume))
      refuse(origin.cell(c),
             "its volume cannot be represented (longest edge {:.3g} m); check the unit of length, metres are expected",
             shape.longest_edge);
  }
}

[[noreturn]] void refuse_overlap(const Mesh& mesh, int a, int b, const MeshOrigin& origin) {
  const auto sorted_corners = [&](int cell) {
    const auto corners = mesh.cells.corners(static_cast<std::size_t>(cell));
    return std::set<int>(corners.begin(), corners.end());
  };
  if (sorted_corners(a) == sorted_corners(b))
    refuse(origin.cell(b),
           "the same nodes as {}; an element belongs to one region: remove one of the two (Gmsh: a volume in two "
           "physical volumes?)",
           origin.cell(a));
  refuse(origin.cell(b), "overlaps {} (both lie on the same side of a common face); remesh", origin.cell(a));
}

void check_overlaps(const Mesh& mesh, const std::vector<MeshFace>& faces, const MeshOrigin& origin) {
  int first = -1;  // the first element that overlaps an earlier one
  int earlier = -1;
  for (std::size_t f = 1; f < faces.size(); ++f) {
    const bool same_side = faces[f].corners == faces[f - 1].corners && faces[f].flipped == faces[f - 1].flipped;
    if (!same_side || (first >= 0 && faces[f].cell >= first)) continue;
    first = faces[f].cell;
    earlier = faces[f - 1].cell;
  }
  if (first >= 0) refuse_overlap(mesh, earlier, first, origin);
}

// No triangle of a tet may lie on a quadrilateral: the displacements of the two would not match.
void check_matching_faces(const Mesh& mesh, const std::vector<MeshFace>& faces, const MeshOrigin& origin) {
  const auto is_triangle = [](const MeshFace& face) { return face.corners.size() == 3; };
  if (mesh.has_tets_only() || std::none_of(faces.begin(), faces.end(), is_triangle)) return;
  for (std::size_t begin = 0; begin < faces.size(); begin = end_of_face(faces, begin)) {
    const MeshFace& quad = faces[begin];
    if (is_triangle(quad) || end_of_face(faces, begin) > begin + 1) continue;  // the other side has the same face
    const auto& c = quad.corners;
    for (const FaceCorners& half : {FaceCorners(c[0], c[1], c[2]), FaceCorners(c[0], c[2], c[3]),
                                    FaceCorners(c[1], c[2], c[3]), FaceCorners(c[0], c[1], c[3])}) {
      const auto [first, end] = find_faces(faces, half);
      if (first == end) continue;
      refuse(origin.cell(faces[first].cell),
             "one of its triangles lies on a quadrilateral of {}, whose displacements do not match; set `split: true` "
             "(convert: --split), so that all elements become tetrahedra, or mesh without this contact",
             origin.cell(quad.cell));
    }
  }
}

void clean_surface(const std::string& surface, std::vector<FaceCorners>& listed, const std::vector<MeshFace>& faces,
                   const MeshOrigin& origin, Warnings& warnings) {
  std::set<std::size_t> seen;
  std::vector<FaceCorners> kept;
  for (int k = 0; k < count(listed); ++k) {
    const FaceCorners& corners = listed[static_cast<std::size_t>(k)];
    const auto [face, end] = find_faces(faces, corners);
    if (face == end)
      refuse(origin.face(surface, k),
             "surface \"{}\": not a face of any element; is the volume behind this surface part of the mesh?", surface);
    if (!seen.insert(face).second) continue;
    const bool outer = end == face + 1;
    kept.push_back(outer ? faces[face].outward() : corners);
  }
  if (kept.size() != listed.size())
    warnings.push_back(fmt::format("{}: surface \"{}\": {} of {} faces repeat an earlier one; each counts once",
                                   origin.source, surface, listed.size() - kept.size(), listed.size()));
  listed = std::move(kept);
}

void remove_unused_nodes(Mesh& mesh, const std::vector<char>& used, const MeshOrigin& origin, Warnings& warnings) {
  const auto unused = std::count(used.begin(), used.end(), 0);
  if (unused == 0) return;
  const auto first = std::find(used.begin(), used.end(), 0) - used.begin();
  warnings.push_back(fmt::format("{}: removed {} node{} that no element uses (first: {})", origin.source, unused,
                                 unused == 1 ? "" : "s", origin.node(static_cast<int>(first))));
  std::vector<char> marked(used.size());
  std::transform(used.begin(), used.end(), marked.begin(), [](char is_used) { return is_used ? 0 : 1; });
  remove_nodes(mesh, marked);
}

void sort_node_sets(Mesh& mesh) {
  for (auto& [set, nodes] : mesh.node_sets) {
    std::sort(nodes.begin(), nodes.end());
    nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
  }
}

}  // namespace

Warnings validate(Mesh& mesh, const MeshOrigin& origin) {
  check_sizes(mesh, origin);
  check_indices(mesh, origin);
  check_coordinates(mesh, origin);
  const std::vector<char> used = used_nodes(mesh);
  check_coincident_nodes(mesh, used, origin);
  check_volumes(mesh, origin);
  if (mesh.order() == 2) validate_quadratic(mesh, origin);
  check_folding(mesh, origin);
  const std::vector<MeshFace> faces = sorted_faces(mesh);
  check_overlaps(mesh, faces, origin);
  check_matching_faces(mesh, faces, origin);

  Warnings warnings;
  for (auto& [surface, listed] : mesh.surfaces) clean_surface(surface, listed, faces, origin, warnings);
  sort_node_sets(mesh);
  remove_unused_nodes(mesh, used, origin, warnings);
  return warnings;
}

}  // namespace orthodyn
