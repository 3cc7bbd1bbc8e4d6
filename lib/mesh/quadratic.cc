#include "lib/mesh/quadratic.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <map>
#include <utility>

#include "lib/core/errors.h"
#include "lib/mesh/element_of_shape.h"

namespace orthodyn {

std::uint64_t edge_key(int a, int b) {
  const auto [low, high] = std::minmax(a, b);
  return static_cast<std::uint64_t>(low) << 32 | static_cast<std::uint64_t>(high);
}

namespace {

// Of the diagonal through the smallest corner of a quadrilateral: the same for all its cells.
std::uint64_t face_key(FaceCorners face) {
  face.sort();
  return edge_key(face[0], face[2]);
}

// The node at a place in a cell.
int node_at(std::span<const int> nodes, int place) { return nodes[static_cast<std::size_t>(place)]; }

FaceCorners face_of(std::span<const int> nodes, const std::vector<int>& corners) {
  return {node_at(nodes, corners[0]), node_at(nodes, corners[1]), node_at(nodes, corners[2]),
          node_at(nodes, corners[3])};
}

// Adds the mid-edge nodes of surface edges whose ends are both in the set. Precondition: the set is sorted.
void add_middles(const MiddleNodes& middles, const std::vector<FaceCorners>& surface, std::vector<int>& set) {
  std::vector<int> more;
  const auto has = [&](int node) { return std::binary_search(set.begin(), set.end(), node); };
  for (const FaceCorners& face : surface)
    for (std::size_t k = 0; k < face.size(); ++k)
      if (has(face[k]) && has(face.after(k))) more.push_back(middles.of_edge(face[k], face.after(k)));
  set.insert(set.end(), more.begin(), more.end());
  std::sort(set.begin(), set.end());
  set.erase(std::unique(set.begin(), set.end()), set.end());
}

// A middle node must belong to one edge or face only, and an edge or face must have the same middle node in all its
// elements.
void check_middle_nodes(const Mesh& mesh, const MeshOrigin& origin) {
  std::vector<char> corner(mesh.nodes.size(), 0);
  for (std::size_t c = 0; c < mesh.cells.size(); ++c)
    for (const int n : mesh.cells.corners(c)) corner[static_cast<std::size_t>(n)] = 1;
  using Pair = std::pair<int, int>;
  std::vector<Pair> between(mesh.nodes.size(), {-1, -1});  // of a middle node: the ends of its edge or diagonal
  const MiddleNodes middles(mesh);                         // of the first element that has the edge
  for (int e = 0; e < static_cast<int>(mesh.cells.size()); ++e) {
    const auto nodes = mesh.cells[static_cast<std::size_t>(e)];
    const CellTopology& cell = topology(mesh.cells.shape(static_cast<std::size_t>(e)));
    for (std::size_t m = 0; m < cell.middles.size(); ++m) {
      const std::vector<int>& of = cell.middles[m];
      const int middle = nodes[static_cast<std::size_t>(cell.corners) + m];
      // Of a cell's centre: opposite corners, which are no diagonal of a face.
      Pair ends{node_at(nodes, of[0]), node_at(nodes, of.size() == 8 ? of[6] : of.back())};
      int expected = middle;
      if (of.size() == 2) {
        expected = middles.of_edge(ends.first, ends.second);
      } else if (of.size() == 4) {
        FaceCorners face = face_of(nodes, of);
        expected = *middles.of_face(face);
        face.sort();
        ends = {face[0], face[2]};
      }
      if (ends.first > ends.second) std::swap(ends.first, ends.second);
      auto& known = between[static_cast<std::size_t>(middle)];
      const bool elsewhere = known.first >= 0 && known != ends;
      known = ends;
      if (!corner[static_cast<std::size_t>(middle)] && !elsewhere && expected == middle) continue;
      if (of.size() == 2)
        throw ConfigError(
            origin.cell(e),
            fmt::format(
                "{} is the mid-edge node between {} and {}, but another element uses it as a corner or on another "
                "edge, or has another node on this edge. Elements must share all nodes of a common edge: remesh, or "
                "check "
                "that the nodes of each element are in the order of the format",
                origin.node(middle), origin.node(ends.first), origin.node(ends.second)));
      throw ConfigError(
          origin.cell(e),
          fmt::format("{} is the middle node of a face or element, but another element uses it at another place, or "
                      "has another node within this face; elements must share all nodes of a common face: remesh",
                      origin.node(middle)));
    }
  }
}

// Faces without a node in their middle may not meet faces with one: the middle of the one could leave the other.
void check_face_middles(const Mesh& mesh, const MeshOrigin& origin) {
  const auto has_centres = [](CellShape shape) { return shape == CellShape::hex27 || shape == CellShape::wedge18; };
  const auto& shapes = mesh.cells.shapes();
  if (std::none_of(shapes.begin(), shapes.end(), has_centres)) return;
  const MiddleNodes middles(mesh);
  for (std::size_t e = 0; e < mesh.cells.size(); ++e) {
    if (has_centres(shapes[e])) continue;
    const CellTopology& cell = topology(shapes[e]);
    for (std::size_t f = 0; f < cell.faces.size(); ++f)
      if (cell.corners_of_face(f) == 4 && middles.of_face(face_of(mesh.cells[e], cell.faces[f])))
        throw ConfigError(
            origin.cell(static_cast<int>(e)),
            "one of its quadrilaterals has no node in its middle, but the neighbour has one; use elements "
            "with and without such nodes in separate meshes, or set `split: true`");
  }
}

}  // namespace

void validate_quadratic(const Mesh& mesh, const MeshOrigin& origin) {
  check_middle_nodes(mesh, origin);
  check_face_middles(mesh, origin);
}

void MiddleNodes::add(const Mesh& mesh, std::size_t c) {
  const auto nodes = mesh.cells[c];
  const CellTopology& cell = topology(mesh.cells.shape(c));
  for (std::size_t m = 0; m < cell.middles.size(); ++m) {
    const std::vector<int>& of = cell.middles[m];
    const int middle = nodes[static_cast<std::size_t>(cell.corners) + m];
    if (of.size() == 2) edges_.emplace(edge_key(node_at(nodes, of[0]), node_at(nodes, of[1])), middle);
    if (of.size() == 4) faces_.emplace(face_key(face_of(nodes, of)), middle);
  }
}

MiddleNodes::MiddleNodes(const Mesh& mesh) {
  edges_.reserve(mesh.cells.size() + mesh.cells.size() / 2);  // a large mesh has about 1.2 edges a tet
  for (std::size_t c = 0; c < mesh.cells.size(); ++c) add(mesh, c);
}

MiddleNodes::MiddleNodes(const Mesh& mesh, const std::vector<FaceCorners>& faces) {
  std::vector<char> wanted(mesh.nodes.size(), 0);
  for (const FaceCorners& face : faces)
    for (const int n : face) wanted[static_cast<std::size_t>(n)] = 1;
  for (std::size_t c = 0; c < mesh.cells.size(); ++c) {
    const auto corners = mesh.cells.corners(c);
    if (std::count_if(corners.begin(), corners.end(), [&](int n) { return wanted[static_cast<std::size_t>(n)]; }) > 1)
      add(mesh, c);
  }
}

int MiddleNodes::of_edge(int a, int b) const { return edges_.at(edge_key(a, b)); }

std::optional<int> MiddleNodes::of_face(const FaceCorners& face) const {
  if (face.size() != 4) return std::nullopt;
  const auto found = faces_.find(face_key(face));
  return found == faces_.end() ? std::nullopt : std::optional(found->second);
}

namespace {

CellShape quadratic_shape(CellShape linear) {
  switch (linear) {
    case CellShape::tet4: return CellShape::tet10;
    case CellShape::wedge6: return CellShape::wedge15;
    case CellShape::hex8: return CellShape::hex20;
    default: return linear;
  }
}

CellShape linear_shape(CellShape quadratic) {
  switch (topology(quadratic).corners) {
    case 4: return CellShape::tet4;
    case 6: return CellShape::wedge6;
    default: return CellShape::hex8;
  }
}

}  // namespace

void make_quadratic(Mesh& mesh, const MiddlePlace& place) {
  std::unordered_map<std::uint64_t, int> middles;
  const auto middle = [&](int a, int b) {
    const auto [entry, is_new] = middles.try_emplace(edge_key(a, b), static_cast<int>(mesh.nodes.size()));
    if (is_new) mesh.nodes.push_back(place ? place(a, b) : Vec3(0.5 * (mesh.node(a) + mesh.node(b))));
    return entry->second;
  };
  Cells cells;
  std::vector<int> nodes;
  for (std::size_t c = 0; c < mesh.cells.size(); ++c) {
    const CellShape shape = quadratic_shape(mesh.cells.shape(c));
    nodes.assign(mesh.cells[c].begin(), mesh.cells[c].end());
    for (const std::vector<int>& edge : topology(shape).middles)
      nodes.push_back(middle(node_at(mesh.cells[c], edge[0]), node_at(mesh.cells[c], edge[1])));
    cells.add(shape, nodes);
  }
  mesh.cells = std::move(cells);
  if (mesh.node_sets.empty()) return;
  const MiddleNodes all(mesh);
  const auto surface = boundary_faces(mesh);
  for (auto& [name, set] : mesh.node_sets) add_middles(all, surface, set);
}

std::vector<std::string> make_linear(Mesh& mesh) {
  std::vector<char> is_middle(mesh.nodes.size(), 0);
  Cells cells;
  for (std::size_t c = 0; c < mesh.cells.size(); ++c) {
    const auto corners = mesh.cells.corners(c);
    for (const int n : mesh.cells[c].subspan(corners.size())) is_middle[static_cast<std::size_t>(n)] = 1;
    cells.add(linear_shape(mesh.cells.shape(c)), corners);
  }
  std::vector<std::string> emptied;
  for (const auto& [name, set] : mesh.node_sets)
    if (!set.empty() &&
        std::all_of(set.begin(), set.end(), [&](int n) { return is_middle[static_cast<std::size_t>(n)]; }))
      emptied.push_back(name);
  mesh.cells = std::move(cells);
  remove_nodes(mesh, is_middle);
  return emptied;
}

void add_centres(Mesh& mesh) {
  std::map<FaceCorners, int> faces;
  Cells cells;
  std::vector<int> nodes;
  for (std::size_t c = 0; c < mesh.cells.size(); ++c) {
    nodes.assign(mesh.cells[c].begin(), mesh.cells[c].end());
    CellShape shape = mesh.cells.shape(c);
    const auto add = [&]<class E, class Full>() {
      const ElementNodes<E::kNodes> X = positions<E>(mesh, c);
      const CellTopology& full = topology(Full::kShape);
      for (std::size_t k = nodes.size(); k < Full::kNodes; ++k) {
        const std::vector<int>& of = full.middles[k - static_cast<std::size_t>(full.corners)];
        int node = static_cast<int>(mesh.nodes.size());
        if (of.size() == 4) {
          FaceCorners face(nodes[static_cast<std::size_t>(of[0])], nodes[static_cast<std::size_t>(of[1])],
                           nodes[static_cast<std::size_t>(of[2])], nodes[static_cast<std::size_t>(of[3])]);
          face.sort();
          node = faces.try_emplace(face, node).first->second;
        }
        if (node == static_cast<int>(mesh.nodes.size()))
          mesh.nodes.push_back(X * E::shape(Full::nodes().col(static_cast<Eigen::Index>(k))));
        nodes.push_back(node);
      }
      shape = Full::kShape;
    };
    if (shape == CellShape::hex20) add.template operator()<Hex20, Hex27>();
    if (shape == CellShape::wedge15) add.template operator()<Wedge15, Wedge18>();
    cells.add(shape, nodes);
  }
  mesh.cells = std::move(cells);
  if (mesh.node_sets.empty()) return;
  const Cells surface = face_cells(mesh, boundary_faces(mesh));
  for (auto& [name, set] : mesh.node_sets) {
    const auto has = [&, known = set.size()](int node) {
      return std::binary_search(set.begin(), set.begin() + static_cast<std::ptrdiff_t>(known), node);
    };
    for (std::size_t k = 0; k < surface.size(); ++k)
      if (surface.shape(k) == CellShape::quad9 && std::all_of(surface[k].begin(), surface[k].end() - 1, has))
        set.push_back(surface[k].back());
    std::sort(set.begin(), set.end());
    set.erase(std::unique(set.begin(), set.end()), set.end());
  }
}

Cells face_cells(const Mesh& mesh, const std::vector<FaceCorners>& faces) {
  Cells out;
  if (mesh.order() == 1) {
    for (const FaceCorners& face : faces)
      out.add(face.size() == 3 ? CellShape::tri3 : CellShape::quad4, {face.begin(), face.end()});
    return out;
  }
  const MiddleNodes middles(mesh, faces);
  std::vector<int> nodes;
  for (const FaceCorners& face : faces) {
    nodes.assign(face.begin(), face.end());
    for (std::size_t k = 0; k < face.size(); ++k) nodes.push_back(middles.of_edge(face[k], face.after(k)));
    const std::optional<int> centre = middles.of_face(face);
    if (centre) nodes.push_back(*centre);
    out.add(face.size() == 3 ? CellShape::tri6 : centre ? CellShape::quad9 : CellShape::quad8, nodes);
  }
  return out;
}

}  // namespace orthodyn
