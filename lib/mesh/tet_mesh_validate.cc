// validate(): one function per thing that can be wrong with a mesh.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <set>
#include <tuple>
#include <unordered_map>
#include <utility>

#include "lib/core/errors.h"
#include "lib/element/tet10.h"
#include "lib/mesh/quadratic.h"
#include "lib/mesh/tet_faces.h"
#include "lib/mesh/tet_mesh.h"

namespace orthodyn {
namespace {

// Far above rounding (a flat tet comes out at about 1e-16), far below any legal sliver (a dihedral
// angle of 0.01 degree gives about 1e-4).
constexpr double kDegenerate = 1e-14;

const Vec3& node(const TetMesh& mesh, int index) { return mesh.nodes[static_cast<std::size_t>(index)]; }

int count(const auto& container) { return static_cast<int>(container.size()); }

std::string tet_name(const MeshOrigin& origin, int tet) {
  return origin.tet_name ? origin.tet_name(tet) : fmt::format("{}: element {}", origin.source, tet);
}

std::string node_name(const MeshOrigin& origin, int n) {
  return origin.node_name ? origin.node_name(n) : fmt::format("{}: node {}", origin.source, n);
}

std::string triangle_name(const MeshOrigin& origin, const std::string& surface, int triangle) {
  return origin.triangle_name ? origin.triangle_name(surface, triangle)
                              : fmt::format("{}: triangle {}", origin.source, triangle);
}

void check_sizes(const TetMesh& mesh, const MeshOrigin& origin) {
  if (mesh.tets.empty()) {
    throw ConfigError(origin.source, "the mesh has no solid elements");
  }
  constexpr auto kMax = static_cast<std::size_t>(std::numeric_limits<int>::max());
  if (mesh.nodes.size() > kMax || mesh.tets.size() > kMax) {
    throw ConfigError(origin.source, fmt::format("{} nodes and {} elements; at most {} of each can be numbered",
                                                 mesh.nodes.size(), mesh.tets.size(), kMax));
  }
  if (mesh.region_of.size() != mesh.tets.size()) {
    throw ConfigError(origin.source,
                      fmt::format("{} elements but a region for {} of them", mesh.tets.size(), mesh.region_of.size()));
  }
  if (mesh.order() == 2 && mesh.midsides.size() != mesh.tets.size()) {
    throw ConfigError(origin.source, fmt::format("{} of {} elements are quadratic; all must be of one order",
                                                 mesh.midsides.size(), mesh.tets.size()));
  }
}

void check_indices(const TetMesh& mesh, const MeshOrigin& origin) {
  const auto check_node = [&](int n, const auto& name) {
    if (n >= 0 && n < count(mesh.nodes)) return;
    throw ConfigError(name(), fmt::format("uses node {}, but there are {} nodes (0 to {})", n, mesh.nodes.size(),
                                          count(mesh.nodes) - 1));
  };
  for (int t = 0; t < count(mesh.tets); ++t) {
    const auto i = static_cast<std::size_t>(t);
    for (int n : mesh.tets[i]) check_node(n, [&] { return tet_name(origin, t); });
    if (mesh.order() == 2)
      for (int n : mesh.midsides[i]) check_node(n, [&] { return tet_name(origin, t); });
    if (mesh.region_of[i] < 0 || mesh.region_of[i] >= count(mesh.region_names)) {
      throw ConfigError(tet_name(origin, t), fmt::format("in region {}, but there are {} regions", mesh.region_of[i],
                                                         mesh.region_names.size()));
    }
  }
  for (const auto& [surface, triangles] : mesh.surfaces) {
    for (int k = 0; k < count(triangles); ++k) {
      for (int n : triangles[static_cast<std::size_t>(k)]) {
        check_node(n, [&, &name = surface] { return triangle_name(origin, name, k); });
      }
    }
  }
  for (const auto& [set, nodes] : mesh.node_sets) {
    for (int n : nodes) {
      check_node(n, [&, &name = set] { return fmt::format("{}: node set \"{}\"", origin.source, name); });
    }
  }
}

void check_coordinates(const TetMesh& mesh, const MeshOrigin& origin) {
  for (int n = 0; n < count(mesh.nodes); ++n) {
    const Vec3& x = node(mesh, n);
    if (x.allFinite()) continue;
    throw ConfigError(node_name(origin, n), fmt::format("coordinates ({}, {}, {}) are not finite", x[0], x[1], x[2]));
  }
}

std::vector<char> used_nodes(const TetMesh& mesh) {
  std::vector<char> used(mesh.nodes.size(), 0);
  for (const Tet& tet : mesh.tets) {
    for (int n : tet) used[static_cast<std::size_t>(n)] = 1;
  }
  for (const Midsides& middles : mesh.midsides) {
    for (int n : middles) used[static_cast<std::size_t>(n)] = 1;
  }
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
  throw ConfigError(node_name(origin, other->node),
                    fmt::format("at exactly the same place ({}, {}, {}) as {}; elements that only touch there "
                                "are not connected: merge the two nodes (Gmsh: \"Coherence\" before meshing, "
                                "\"Coherence Mesh\" after)",
                                other->x, other->y, other->z, node_name(origin, same->node)));
}

// Edges in units of the largest coordinate difference, so that nothing over- or underflows before
// the ratio is taken: tiny and huge meshes are judged alike.
struct TetShape {
  double longest_edge;  // m
  double ratio;         // six signed volumes over the longest edge cubed; NaN if all nodes coincide
};

TetShape shape_of(const TetMesh& mesh, const Tet& tet) {
  Mat3 edges;
  for (int i = 0; i < 3; ++i) {
    edges.col(i) = node(mesh, tet[static_cast<std::size_t>(i) + 1]) - node(mesh, tet[0]);
  }
  const double scale = edges.cwiseAbs().maxCoeff();
  edges /= scale;
  double longest = 0;
  for (int i = 0; i < 3; ++i) {
    longest = std::max({longest, edges.col(i).norm(), (edges.col(i) - edges.col((i + 1) % 3)).norm()});
  }
  const double volume6 = edges.col(0).dot(edges.col(1).cross(edges.col(2)));
  return {scale * longest, volume6 / (longest * longest * longest)};
}

[[noreturn]] void refuse_inverted(const TetMesh& mesh, int first, const MeshOrigin& origin) {
  int inverted = 0;
  for (const Tet& tet : mesh.tets) inverted += shape_of(mesh, tet).ratio < -kDegenerate;
  const std::string more =
      inverted == 1 ? "" : fmt::format("; {} of {} elements are inverted", inverted, mesh.tets.size());
  throw ConfigError(tet_name(origin, first),
                    fmt::format("inverted (volume {:.3g} m^3); reorder two of its nodes or remesh{}",
                                signed_volume6(mesh, mesh.tets[static_cast<std::size_t>(first)]) / 6, more));
}

void check_volumes(const TetMesh& mesh, const MeshOrigin& origin) {
  for (int t = 0; t < count(mesh.tets); ++t) {
    const Tet& tet = mesh.tets[static_cast<std::size_t>(t)];
    const TetShape shape = shape_of(mesh, tet);
    if (!(std::abs(shape.ratio) >= kDegenerate)) {  // NaN too
      throw ConfigError(tet_name(origin, t),
                        fmt::format("degenerate (volume {:.3g} m^3, longest edge {:.3g} m); remesh, or move "
                                    "its nodes apart",
                                    signed_volume6(mesh, tet) / 6, shape.longest_edge));
    }
    if (shape.ratio < 0) refuse_inverted(mesh, t, origin);
    if (!std::isnormal(signed_volume6(mesh, tet) / 6)) {
      throw ConfigError(tet_name(origin, t), fmt::format("its volume cannot be represented (longest edge {:.3g} m); "
                                                         "check the unit of length, metres are expected",
                                                         shape.longest_edge));
    }
  }
}

// A node on an edge belongs to that edge alone, and is the same for all elements around it.
void check_edges(const TetMesh& mesh, const MeshOrigin& origin) {
  std::vector<char> corner(mesh.nodes.size(), 0);
  for (const Tet& tet : mesh.tets)
    for (int n : tet) corner[static_cast<std::size_t>(n)] = 1;
  std::vector<std::pair<int, int>> edge_of(mesh.nodes.size(), {-1, -1});
  const EdgeNodes middles(mesh);  // of the first element that has the edge
  for (int t = 0; t < count(mesh.tets); ++t) {
    const auto i = static_cast<std::size_t>(t);
    for (std::size_t e = 0; e < kTetEdges.size(); ++e) {
      const int middle = mesh.midsides[i][e], a = mesh.tets[i][kTetEdges[e][0]], b = mesh.tets[i][kTetEdges[e][1]];
      const std::pair<int, int> edge = std::minmax(a, b);
      auto& known = edge_of[static_cast<std::size_t>(middle)];
      const bool elsewhere = known.first >= 0 && known != edge;
      known = edge;
      if (!corner[static_cast<std::size_t>(middle)] && !elsewhere && middles.at(a, b) == middle) continue;
      throw ConfigError(tet_name(origin, t),
                        fmt::format("{} is on the edge between {} and {}, and elsewhere a corner, on another edge or "
                                    "not on this one; elements must share all nodes of a common edge: remesh",
                                    node_name(origin, middle), node_name(origin, a), node_name(origin, b)));
    }
  }
}

constexpr double kFolded = 1e-6;  // of det dX/dL with straight edges

// The map from barycentric coordinates must not turn over where it is asked for. With straight edges it is the same
// everywhere.
void check_curved(const TetMesh& mesh, const MeshOrigin& origin) {
  const Cells cells = tet_cells(mesh);
  for (int t = 0; t < count(mesh.tets); ++t) {
    const auto nodes = cells[static_cast<std::size_t>(t)];
    ElementNodes<Tet10::kNodes> X;
    for (Eigen::Index a = 0; a < X.cols(); ++a) X.col(a) = node(mesh, nodes[static_cast<std::size_t>(a)]);
    const auto is_straight = [&](int e) {
      const auto [i, j] = Tet10::kEdges[static_cast<std::size_t>(e)];
      return (X.col(4 + e) - 0.5 * (X.col(i) + X.col(j))).norm() <= 1e-12 * (X.col(i) - X.col(j)).norm();
    };
    int straight_edges = 0;
    for (int e = 0; e < 6; ++e) straight_edges += is_straight(e);
    if (straight_edges == 6) continue;
    const NodeDifferences<Tet10::kNodes> rest = differences<Tet10::kNodes>(X);
    const double straight = signed_volume6(mesh, mesh.tets[static_cast<std::size_t>(t)]);
    double smallest = std::numeric_limits<double>::infinity();
    for (const auto& L : Tet10::checked_places())
      smallest = std::min(smallest, Tet10::jacobian(rest, L).determinant() / straight);
    if (smallest > kFolded) continue;
    throw ConfigError(tet_name(origin, t),
                      fmt::format("its curved edges fold it over (det dX/dL is {:.3g} of that with straight edges); "
                                  "remesh finer, straighten it (Gmsh: Mesh.SecondOrderLinear = 1), or optimise it "
                                  "(Gmsh: Mesh.HighOrderOptimize)",
                                  smallest));
  }
}

[[noreturn]] void refuse_overlap(const TetMesh& mesh, int a, int b, const MeshOrigin& origin) {
  Tet first = mesh.tets[static_cast<std::size_t>(a)];
  Tet second = mesh.tets[static_cast<std::size_t>(b)];
  std::sort(first.begin(), first.end());
  std::sort(second.begin(), second.end());
  if (first == second) {
    throw ConfigError(tet_name(origin, b), fmt::format("the same nodes as {}; an element belongs to one region: remove "
                                                       "one of the two (Gmsh: a volume in two physical volumes?)",
                                                       tet_name(origin, a)));
  }
  throw ConfigError(tet_name(origin, b), fmt::format("overlaps {} (both lie on the same side of a common face); remesh",
                                                     tet_name(origin, a)));
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

void settle_surface(const std::string& surface, std::vector<Triangle>& triangles, const std::vector<TetFace>& faces,
                    const MeshOrigin& origin, Warnings& warnings) {
  std::set<std::size_t> seen;
  std::vector<Triangle> kept;
  for (int k = 0; k < count(triangles); ++k) {
    const Triangle& triangle = triangles[static_cast<std::size_t>(k)];
    Triangle key = triangle;
    sort_nodes(key);
    const std::size_t face = find_face(faces, key);
    if (face == faces.size()) {
      throw ConfigError(triangle_name(origin, surface, k),
                        fmt::format("surface \"{}\": not a face of any element; is the volume "
                                    "behind this surface part of the mesh?",
                                    surface));
    }
    if (!seen.insert(face).second) continue;
    const bool outer = end_of_face(faces, face) == face + 1;
    kept.push_back(outer ? faces[face].outward() : triangle);
  }
  if (kept.size() != triangles.size()) {
    warnings.push_back(fmt::format("{}: surface \"{}\": {} of {} triangles repeat an earlier one; each counts once",
                                   origin.source, surface, triangles.size() - kept.size(), triangles.size()));
  }
  triangles = std::move(kept);
}

void remove_unused_nodes(TetMesh& mesh, const std::vector<char>& used, const MeshOrigin& origin, Warnings& warnings) {
  const auto unused = std::count(used.begin(), used.end(), 0);
  if (unused == 0) return;
  const auto first = std::find(used.begin(), used.end(), 0) - used.begin();
  warnings.push_back(fmt::format("{}: removed {} node{} that no element uses (first: {})", origin.source, unused,
                                 unused == 1 ? "" : "s", node_name(origin, static_cast<int>(first))));
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
  if (mesh.order() == 2) {
    check_edges(mesh, origin);
    check_curved(mesh, origin);
  }
  const std::vector<TetFace> faces = sorted_faces(mesh);
  check_overlaps(mesh, faces, origin);

  Warnings warnings;
  for (auto& [surface, triangles] : mesh.surfaces) {
    settle_surface(surface, triangles, faces, origin, warnings);
  }
  sort_node_sets(mesh);
  remove_unused_nodes(mesh, used, origin, warnings);
  return warnings;
}

}  // namespace orthodyn
