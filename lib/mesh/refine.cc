#include "lib/mesh/refine.h"

#include <algorithm>
#include <map>
#include <numeric>
#include <utility>

#include "lib/mesh/element_of_shape.h"
#include "lib/mesh/quadratic.h"

namespace orthodyn {

namespace {

// The corners of a child, as indices of the ten nodes of its parent.
using Child = std::array<std::size_t, 4>;
using Children = std::array<Child, 8>;

constexpr std::array<Child, 4> kAtCorners{{{0, 4, 6, 7}, {4, 1, 5, 8}, {6, 5, 2, 9}, {7, 8, 9, 3}}};

// A diagonal a-b of the inner octahedron and the other four nodes in cyclic order: (a, b, ring i, ring i + 1) has a
// positive volume.
struct Diagonal {
  std::size_t a, b;
  std::array<std::size_t, 4> ring;
};
constexpr std::array<Diagonal, 3> kDiagonals{{{4, 9, {6, 7, 8, 5}}, {6, 8, {5, 9, 7, 4}}, {7, 5, {4, 6, 9, 8}}}};

Children children_of(const std::array<Vec3, 10>& x) {
  const auto length = [&](const Diagonal& d) { return (x[d.a] - x[d.b]).squaredNorm(); };
  // The first of several that are equal up to round-off.
  const Diagonal* shortest = &kDiagonals[0];
  for (const Diagonal& d : kDiagonals)
    if (length(d) < (1 - 1e-9) * length(*shortest)) shortest = &d;
  Children out;
  std::copy(kAtCorners.begin(), kAtCorners.end(), out.begin());
  for (std::size_t i = 0; i < 4; ++i)
    out[4 + i] = {shortest->a, shortest->b, shortest->ring[i], shortest->ring[(i + 1) % 4]};
  return out;
}

// Barycentric coordinates of a node of a quadratic tetrahedron.
Eigen::Vector4d barycentric_of(std::size_t node) {
  if (node < 4) return Eigen::Vector4d::Unit(static_cast<Eigen::Index>(node));
  const auto [i, j] = Tet10::kEdges[node - 4];
  return (Eigen::Vector4d::Unit(i) + Eigen::Vector4d::Unit(j)) / 2;
}

// The corners of a cube in natural coordinates.
std::vector<Vec3> cube_at(const Vec3& centre, double half) {
  std::vector<Vec3> out;
  for (Eigen::Index k = 0; k < 8; ++k) out.push_back(centre + half * Hex20::nodes().col(k));
  return out;
}

// Splits the faces of a mesh in which each cell has all its middles.
void refine_surfaces(Mesh& mesh) {
  static const std::vector<std::vector<std::size_t>> of_triangle{{0, 3, 5}, {3, 1, 4}, {5, 4, 2}, {3, 4, 5}},
      of_quadrilateral{{0, 4, 8, 7}, {4, 1, 5, 8}, {8, 5, 2, 6}, {7, 8, 6, 3}};
  for (auto& [name, listed] : mesh.surfaces) {
    const Cells faces = face_cells(mesh, listed);
    std::vector<FaceCorners> parts;
    for (std::size_t k = 0; k < faces.size(); ++k)
      for (const auto& part : faces.shape(k) == CellShape::tri6 ? of_triangle : of_quadrilateral) {
        std::vector<int> corners;
        for (const std::size_t place : part) corners.push_back(faces[k][place]);
        parts.emplace_back(corners);
      }
    listed = std::move(parts);
  }
}

template <class T>
std::vector<T> repeated(const std::vector<T>& values, std::size_t components) {
  std::vector<T> out;
  out.reserve(8 * values.size());
  for (auto at = values.begin(); at != values.end(); at += static_cast<std::ptrdiff_t>(components))
    for (int i = 0; i < 8; ++i) out.insert(out.end(), at, at + static_cast<std::ptrdiff_t>(components));
  return out;
}

// Collects the children of cells, with the places of the mid-edge nodes that they get if they become quadratic.
struct Refined {
  Cells cells = {};                             // linear
  std::map<std::pair<int, int>, Vec3> middles;  // between corners of the children

  void add_tet(const Mesh& mesh, std::size_t cell) {
    const auto nodes = mesh.cells[cell];
    const ElementNodes<10> X = positions<Tet10>(mesh, cell);
    std::array<Vec3, 10> x;
    for (std::size_t a = 0; a < 10; ++a) x[a] = X.col(static_cast<Eigen::Index>(a));
    for (const Child& child : children_of(x)) {
      cells.add(CellShape::tet4, std::array{nodes[child[0]], nodes[child[1]], nodes[child[2]], nodes[child[3]]});
      for (const auto& [i, j] : kTetEdges) {
        const Eigen::Vector4d L = (barycentric_of(child[i]) + barycentric_of(child[j])) / 2;
        middles.try_emplace(std::minmax(nodes[child[i]], nodes[child[j]]), X * Tet10::shape(L));
      }
    }
  }

  // E: the element with all middles.
  template <class E>
  void add(const Mesh& mesh, std::size_t cell, CellShape linear) {
    const auto nodes = mesh.cells[cell];
    const ElementNodes<E::kNodes> X = positions<E>(mesh, cell);
    for (const std::vector<Vec3>& child : corners_of_children(E::kShape)) {
      std::vector<int> corners;
      for (const Vec3& place : child) {
        Eigen::Index node = 0;
        (E::nodes().colwise() - place).colwise().squaredNorm().minCoeff(&node);
        corners.push_back(nodes[static_cast<std::size_t>(node)]);
      }
      cells.add(linear, corners);
      for (const std::vector<int>& edge : topology(E::kShape).middles) {
        if (edge.size() > 2) continue;
        const auto a = static_cast<std::size_t>(edge[0]), b = static_cast<std::size_t>(edge[1]);
        middles.try_emplace(std::minmax(corners[a], corners[b]), X * E::shape((child[a] + child[b]) / 2));
      }
    }
  }
};

}  // namespace

const std::vector<std::vector<Vec3>>& corners_of_children(CellShape parent) {
  static const std::vector<std::vector<Vec3>> of_hexahedron = [] {
    std::vector<std::vector<Vec3>> all;
    for (const Vec3& corner : cube_at(Vec3::Zero(), 0.5)) all.push_back(cube_at(corner, 0.5));
    return all;
  }();
  static const std::vector<std::vector<Vec3>> of_wedge = [] {
    using Three = std::array<Eigen::Vector2d, 3>;
    const Eigen::Vector2d a(0, 0), b(1, 0), c(0, 1), ab(0.5, 0), bc(0.5, 0.5), ca(0, 0.5);
    std::vector<std::vector<Vec3>> all;
    for (const double bottom : {-1.0, 0.0})
      for (const Three& t : {Three{a, ab, ca}, Three{ab, b, bc}, Three{ca, bc, c}, Three{ab, bc, ca}}) {
        auto& child = all.emplace_back();
        for (const double z : {bottom, bottom + 1})
          for (const Eigen::Vector2d& x : t) child.emplace_back(x[0], x[1], z);
      }
    return all;
  }();
  return topology(parent).corners == 8 ? of_hexahedron : of_wedge;
}

void refine(LoadedMesh& loaded) {
  Mesh& mesh = loaded.mesh;
  const bool quadratic = mesh.order() == 2;
  const std::vector<CellShape> shapes = mesh.cells.shapes();
  if (!quadratic) make_quadratic(mesh);
  add_centres(mesh);
  refine_surfaces(mesh);

  Refined refined;
  for (std::size_t c = 0; c < mesh.cells.size(); ++c) switch (mesh.cells.shape(c)) {
      case CellShape::hex27: refined.add<Hex27>(mesh, c, CellShape::hex8); break;
      case CellShape::wedge18: refined.add<Wedge18>(mesh, c, CellShape::wedge6); break;
      default: refined.add_tet(mesh, c);
    }
  mesh.cells = std::move(refined.cells);
  mesh.region_of = repeated(mesh.region_of, 1);
  if (mesh.cell_of.empty()) {
    mesh.cell_of.resize(shapes.size());
    std::iota(mesh.cell_of.begin(), mesh.cell_of.end(), 0);
  }
  mesh.cell_of = repeated(mesh.cell_of, 1);
  for (CellData& data : loaded.cell_data)
    data.values = repeated(data.values, static_cast<std::size_t>(data.components));
  if (!quadratic) return;
  make_quadratic(mesh, [&](int a, int b) { return refined.middles.at(std::minmax(a, b)); });
  const auto has_centres = [](CellShape s) { return s == CellShape::hex27 || s == CellShape::wedge18; };
  if (std::any_of(shapes.begin(), shapes.end(), has_centres)) add_centres(mesh);
}

}  // namespace orthodyn
