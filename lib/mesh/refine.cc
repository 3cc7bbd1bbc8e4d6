#include "lib/mesh/refine.h"

#include <algorithm>
#include <map>
#include <numeric>
#include <utility>

#include "lib/element/tet10.h"
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

// Barycentric coordinates of a node of a quadratic cell.
Eigen::Vector4d barycentric_of(std::size_t node) {
  if (node < 4) return Eigen::Vector4d::Unit(static_cast<Eigen::Index>(node));
  const auto [i, j] = Tet10::kEdges[node - 4];
  return (Eigen::Vector4d::Unit(i) + Eigen::Vector4d::Unit(j)) / 2;
}

void refine_surfaces(TetMesh& mesh) {
  for (auto& [name, triangles] : mesh.surfaces) {
    const Cells faces = face_cells(mesh, triangles);
    std::vector<Triangle> parts;
    for (std::size_t k = 0; k < faces.size(); ++k) {
      const auto n = faces[k];
      for (const auto& [a, b, c] :
           std::array<std::array<std::size_t, 3>, 4>{{{0, 3, 5}, {3, 1, 4}, {5, 4, 2}, {3, 4, 5}}})
        parts.push_back({n[a], n[b], n[c]});
    }
    triangles = std::move(parts);
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

}  // namespace

void refine(LoadedMesh& loaded) {
  TetMesh& mesh = loaded.mesh;
  const bool quadratic = mesh.order() == 2;
  if (!quadratic) make_quadratic(mesh);
  refine_surfaces(mesh);

  std::vector<Tet> tets;
  std::map<std::pair<int, int>, Vec3> middles;  // of new edges
  const Cells cells = tet_cells(mesh);
  for (std::size_t k = 0; k < cells.size(); ++k) {
    const auto nodes = cells[k];
    std::array<Vec3, 10> x;
    ElementNodes<10> X;
    for (std::size_t a = 0; a < 10; ++a)
      X.col(static_cast<Eigen::Index>(a)) = x[a] = mesh.nodes[static_cast<std::size_t>(nodes[a])];
    for (const Child& child : children_of(x)) {
      tets.push_back({nodes[child[0]], nodes[child[1]], nodes[child[2]], nodes[child[3]]});
      if (!quadratic) continue;
      for (const auto& [i, j] : kTetEdges) {
        const Eigen::Vector4d L = (barycentric_of(child[i]) + barycentric_of(child[j])) / 2;
        middles.try_emplace(std::minmax(nodes[child[i]], nodes[child[j]]), X * Tet10::shape(L));
      }
    }
  }
  mesh.tets = std::move(tets);
  mesh.midsides.clear();
  mesh.region_of = repeated(mesh.region_of, 1);
  if (mesh.cell_of.empty()) {
    mesh.cell_of.resize(cells.size());
    std::iota(mesh.cell_of.begin(), mesh.cell_of.end(), 0);
  }
  mesh.cell_of = repeated(mesh.cell_of, 1);
  for (CellData& data : loaded.cell_data)
    data.values = repeated(data.values, static_cast<std::size_t>(data.components));
  if (quadratic) make_quadratic(mesh, [&](int a, int b) { return middles.at(std::minmax(a, b)); });
}

}  // namespace orthodyn
