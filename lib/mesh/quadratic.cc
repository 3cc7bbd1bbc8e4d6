#include "lib/mesh/quadratic.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <utility>

#include "lib/core/errors.h"
#include "lib/element/tet10.h"

namespace orthodyn {

std::uint64_t edge_key(int a, int b) {
  const auto [low, high] = std::minmax(a, b);
  return static_cast<std::uint64_t>(low) << 32 | static_cast<std::uint64_t>(high);
}

namespace {

// Adds the mid-edge nodes of surface edges whose ends are both in the set. Precondition: the set is sorted.
void add_middles(const EdgeNodes& middles, const std::vector<Triangle>& surface, std::vector<int>& set) {
  std::vector<int> more;
  const auto has = [&](int node) { return std::binary_search(set.begin(), set.end(), node); };
  for (const Triangle& t : surface)
    for (std::size_t k = 0; k < 3; ++k)
      if (has(t[k]) && has(t[(k + 1) % 3])) more.push_back(middles.at(t[k], t[(k + 1) % 3]));
  set.insert(set.end(), more.begin(), more.end());
  std::sort(set.begin(), set.end());
  set.erase(std::unique(set.begin(), set.end()), set.end());
}

constexpr double kFolded = 1e-6;  // relative to det dX/dL with straight edges

// A mid-edge node must belong to one edge only, and an edge must have the same mid-edge node in all its elements.
void check_mid_edge_nodes(const TetMesh& mesh, const MeshOrigin& origin) {
  std::vector<char> corner(mesh.nodes.size(), 0);
  for (const Tet& tet : mesh.tets)
    for (int n : tet) corner[static_cast<std::size_t>(n)] = 1;
  std::vector<std::pair<int, int>> edge_of(mesh.nodes.size(), {-1, -1});
  const EdgeNodes middles(mesh);  // of the first element that has the edge
  for (int t = 0; t < static_cast<int>(mesh.tets.size()); ++t) {
    const auto i = static_cast<std::size_t>(t);
    for (std::size_t e = 0; e < kTetEdges.size(); ++e) {
      const int middle = mesh.midsides[i][e], a = mesh.tets[i][kTetEdges[e][0]], b = mesh.tets[i][kTetEdges[e][1]];
      const std::pair<int, int> edge = std::minmax(a, b);
      auto& known = edge_of[static_cast<std::size_t>(middle)];
      const bool elsewhere = known.first >= 0 && known != edge;
      known = edge;
      if (!corner[static_cast<std::size_t>(middle)] && !elsewhere && middles.at(a, b) == middle) continue;
      throw ConfigError(
          origin.tet(t),
          fmt::format(
              "{} is the mid-edge node between {} and {}, but another element uses it as a corner or on another edge, "
              "or has another node on this edge; elements must share all nodes of a common edge: remesh",
              origin.node(middle), origin.node(a), origin.node(b)));
    }
  }
}

// The map from barycentric coordinates must keep its orientation at all evaluation points. It is constant if all edges
// are straight.
void check_folding(const TetMesh& mesh, const MeshOrigin& origin) {
  const Cells cells = tet_cells(mesh);
  for (int t = 0; t < static_cast<int>(mesh.tets.size()); ++t) {
    const auto nodes = cells[static_cast<std::size_t>(t)];
    ElementNodes<Tet10::kNodes> X;
    for (Eigen::Index a = 0; a < X.cols(); ++a)
      X.col(a) = mesh.nodes[static_cast<std::size_t>(nodes[static_cast<std::size_t>(a)])];
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
    throw ConfigError(
        origin.tet(t),
        fmt::format("its curved edges fold it over (det dX/dL is {:.3g} of that with straight edges); remesh finer, "
                    "straighten it (Gmsh: Mesh.SecondOrderLinear = 1), or optimise it (Gmsh: Mesh.HighOrderOptimize)",
                    smallest));
  }
}

}  // namespace

void validate_quadratic(const TetMesh& mesh, const MeshOrigin& origin) {
  check_mid_edge_nodes(mesh, origin);
  check_folding(mesh, origin);
}

EdgeNodes::EdgeNodes(const TetMesh& mesh) {
  nodes_.reserve(mesh.tets.size() + mesh.tets.size() / 2);  // a large mesh has about 1.2 edges a tet
  for (std::size_t t = 0; t < mesh.midsides.size(); ++t)
    for (std::size_t e = 0; e < kTetEdges.size(); ++e)
      nodes_.emplace(edge_key(mesh.tets[t][kTetEdges[e][0]], mesh.tets[t][kTetEdges[e][1]]), mesh.midsides[t][e]);
}

EdgeNodes::EdgeNodes(const TetMesh& mesh, const std::vector<Triangle>& faces) {
  std::vector<char> wanted(mesh.nodes.size(), 0);
  for (const Triangle& t : faces)
    for (const int n : t) wanted[static_cast<std::size_t>(n)] = 1;
  for (std::size_t t = 0; t < mesh.midsides.size(); ++t)
    for (std::size_t e = 0; e < kTetEdges.size(); ++e) {
      const int a = mesh.tets[t][kTetEdges[e][0]], b = mesh.tets[t][kTetEdges[e][1]];
      if (wanted[static_cast<std::size_t>(a)] && wanted[static_cast<std::size_t>(b)])
        nodes_.emplace(edge_key(a, b), mesh.midsides[t][e]);
    }
}

int EdgeNodes::at(int a, int b) const { return nodes_.at(edge_key(a, b)); }

void make_quadratic(TetMesh& mesh, const MiddlePlace& place) {
  std::unordered_map<std::uint64_t, int> middles;
  const auto middle = [&](int a, int b) {
    const auto [entry, is_new] = middles.try_emplace(edge_key(a, b), static_cast<int>(mesh.nodes.size()));
    if (is_new) {
      const auto at = [&](int n) -> const Vec3& { return mesh.nodes[static_cast<std::size_t>(n)]; };
      mesh.nodes.push_back(place ? place(a, b) : Vec3(0.5 * (at(a) + at(b))));
    }
    return entry->second;
  };
  mesh.midsides.resize(mesh.tets.size());
  for (std::size_t t = 0; t < mesh.tets.size(); ++t)
    for (std::size_t e = 0; e < kTetEdges.size(); ++e)
      mesh.midsides[t][e] = middle(mesh.tets[t][kTetEdges[e][0]], mesh.tets[t][kTetEdges[e][1]]);
  if (mesh.node_sets.empty()) return;
  const EdgeNodes all(mesh);
  const auto surface = boundary_triangles(mesh);
  for (auto& [name, set] : mesh.node_sets) add_middles(all, surface, set);
}

std::vector<std::string> make_linear(TetMesh& mesh) {
  std::vector<char> is_middle(mesh.nodes.size(), 0);
  for (const Midsides& middles : mesh.midsides)
    for (const int n : middles) is_middle[static_cast<std::size_t>(n)] = 1;
  std::vector<std::string> emptied;
  for (const auto& [name, set] : mesh.node_sets)
    if (!set.empty() &&
        std::all_of(set.begin(), set.end(), [&](int n) { return is_middle[static_cast<std::size_t>(n)]; }))
      emptied.push_back(name);
  mesh.midsides.clear();
  remove_nodes(mesh, is_middle);
  return emptied;
}

Cells tet_cells(const TetMesh& mesh) {
  if (mesh.order() == 1) return Cells(mesh.tets);
  std::vector<int> nodes;
  nodes.reserve(10 * mesh.tets.size());
  for (std::size_t t = 0; t < mesh.tets.size(); ++t) {
    nodes.insert(nodes.end(), mesh.tets[t].begin(), mesh.tets[t].end());
    nodes.insert(nodes.end(), mesh.midsides[t].begin(), mesh.midsides[t].end());
  }
  return {10, std::move(nodes)};
}

Cells face_cells(const TetMesh& mesh, const std::vector<Triangle>& triangles) {
  if (mesh.order() == 1) return Cells(triangles);
  const EdgeNodes middles(mesh, triangles);
  std::vector<int> nodes;
  nodes.reserve(6 * triangles.size());
  for (const Triangle& t : triangles) {
    nodes.insert(nodes.end(), t.begin(), t.end());
    for (std::size_t k = 0; k < 3; ++k) nodes.push_back(middles.at(t[k], t[(k + 1) % 3]));
  }
  return {6, std::move(nodes)};
}

}  // namespace orthodyn
