#include "lib/mesh/box.h"

#include <fmt/format.h>

#include <cmath>
#include <cstddef>
#include <limits>
#include <span>
#include <string>
#include <utility>

#include "lib/core/errors.h"

namespace orthodyn {
namespace {

// Corner (i, j, k) of the unit cell has the number i + 2 j + 4 k. All tets below have a positive volume.
constexpr Tet kFive[] = {{0, 5, 3, 6}, {1, 3, 0, 5}, {2, 0, 3, 6}, {4, 6, 5, 0}, {7, 5, 6, 3}};
constexpr Tet kSix[] = {{0, 1, 3, 7}, {0, 2, 6, 7}, {0, 4, 5, 7}, {0, 5, 1, 7}, {0, 6, 4, 7}, {0, 3, 2, 7}};

std::span<const Tet> cell_tets(BoxMesh::Split split) {
  if (split == BoxMesh::Split::five) return kFive;
  return kSix;
}

double elements_per_cell(const BoxMesh& box) {
  switch (box.elements) {
    case BoxMesh::Elements::hexahedra: return 1;
    case BoxMesh::Elements::wedges: return 2;
    default: return static_cast<double>(cell_tets(box.split).size());
  }
}

void check(const BoxMesh& box) {
  constexpr const char* kAxis[] = {"x", "y", "z"};
  double nodes = 1;
  double elements = elements_per_cell(box);
  for (std::size_t a = 0; a < 3; ++a) {
    const double size = box.size[static_cast<Eigen::Index>(a)];
    if (!(size > 0) || !std::isfinite(size))
      throw ConfigError(fmt::format("box size {} m along {}; it must be positive and finite", size, kAxis[a]));
    if (box.cells[a] < 1)
      throw ConfigError(fmt::format("{} cells along {}; there must be at least 1", box.cells[a], kAxis[a]));
    nodes *= box.cells[a] + 1.0;
    elements *= box.cells[a];
  }
  if (!box.layers.empty() && box.layers.size() != static_cast<std::size_t>(box.cells[2]))
    throw ConfigError(fmt::format("{} heights of layers for {} cells along z", box.layers.size(), box.cells[2]));
  for (const double height : box.layers)
    if (!(height > 0) || !std::isfinite(height))
      throw ConfigError(fmt::format("a layer of height {}; it must be positive and finite", height));
  if (!box.origin.allFinite()) throw ConfigError("the origin of the box is not finite");
  constexpr int kMax = std::numeric_limits<int>::max();
  if (nodes > kMax || elements > kMax)
    throw ConfigError(
        fmt::format("{} x {} x {} cells make {:.3g} nodes and {:.3g} elements; at most {} can be numbered",
                    box.cells[0], box.cells[1], box.cells[2], nodes, elements, kMax));
}

// Converts between node numbers and grid indices.
struct Grid {
  std::array<int, 3> cells;

  int node(int i, int j, int k) const { return i + (cells[0] + 1) * (j + (cells[1] + 1) * k); }
  std::array<int, 3> place(int n) const {
    const int row = n / (cells[0] + 1);
    return {n % (cells[0] + 1), row % (cells[1] + 1), row / (cells[1] + 1)};
  }
};

// The z coordinate of each plane of nodes above the bottom of the box, divided by the height of the box.
std::vector<double> heights(const BoxMesh& box) {
  std::vector<double> out{0};
  for (std::size_t k = 0; k < static_cast<std::size_t>(box.cells[2]); ++k)
    out.push_back(box.layers.empty() ? static_cast<double>(k + 1) / box.cells[2] : out.back() + box.layers[k]);
  const double total = out.back();
  if (!box.layers.empty())
    for (double& height : out) height /= total;
  return out;
}

std::vector<Vec3> make_nodes(const BoxMesh& box) {
  std::vector<Vec3> nodes;
  const std::vector<double> z = heights(box);
  const Vec3 cells(box.cells[0], box.cells[1], box.cells[2]);
  for (int k = 0; k <= box.cells[2]; ++k) {
    for (int j = 0; j <= box.cells[1]; ++j) {
      for (int i = 0; i <= box.cells[0]; ++i) {
        Vec3 fraction = Vec3(i, j, k).cwiseQuotient(cells);
        fraction[2] = z[static_cast<std::size_t>(k)];
        nodes.push_back(box.origin + box.size.cwiseProduct(fraction));
      }
    }
  }
  return nodes;
}

void append_cell(const Grid& grid, std::array<int, 3> cell, BoxMesh::Split split, std::vector<Tet>& tets) {
  const bool mirrored = split == BoxMesh::Split::five && (cell[0] % 2 + cell[1] % 2 + cell[2] % 2) % 2 == 1;
  for (const Tet& local : cell_tets(split)) {
    Tet tet{};
    for (std::size_t v = 0; v < 4; ++v) {
      const int corner = mirrored ? local[v] ^ 1 : local[v];
      tet[v] = grid.node(cell[0] + (corner & 1), cell[1] + ((corner >> 1) & 1), cell[2] + (corner >> 2));
    }
    if (mirrored) std::swap(tet[2], tet[3]);  // a mirror image is inverted
    tets.push_back(tet);
  }
}

std::vector<Tet> make_tets(const BoxMesh& box) {
  const Grid grid{box.cells};
  std::vector<Tet> tets;
  for (int k = 0; k < box.cells[2]; ++k)
    for (int j = 0; j < box.cells[1]; ++j)
      for (int i = 0; i < box.cells[0]; ++i) append_cell(grid, {i, j, k}, box.split, tets);
  return tets;
}

// Hexahedra or wedges.
Cells make_cells(const BoxMesh& box) {
  const Grid grid{box.cells};
  Cells cells;
  for (int k = 0; k < box.cells[2]; ++k)
    for (int j = 0; j < box.cells[1]; ++j)
      for (int i = 0; i < box.cells[0]; ++i) {
        const auto at = [&](int x, int y, int z) { return grid.node(i + x, j + y, k + z); };
        if (box.elements == BoxMesh::Elements::hexahedra) {
          cells.add(CellShape::hex8, std::array{at(0, 0, 0), at(1, 0, 0), at(1, 1, 0), at(0, 1, 0), at(0, 0, 1),
                                                at(1, 0, 1), at(1, 1, 1), at(0, 1, 1)});
          continue;
        }
        cells.add(CellShape::wedge6, std::array{at(0, 0, 0), at(1, 0, 0), at(1, 1, 0),  //
                                                at(0, 0, 1), at(1, 0, 1), at(1, 1, 1)});
        cells.add(CellShape::wedge6, std::array{at(0, 0, 0), at(1, 1, 0), at(0, 1, 0),  //
                                                at(0, 0, 1), at(1, 1, 1), at(0, 1, 1)});
      }
  return cells;
}

// The name of the side of the box that contains the first three corners.
std::string side_of(const Grid& grid, const FaceCorners& face) {
  const std::array<int, 3> a = grid.place(face[0]);
  const std::array<int, 3> b = grid.place(face[1]);
  const std::array<int, 3> c = grid.place(face[2]);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (a[axis] != b[axis] || a[axis] != c[axis]) continue;
    if (a[axis] == 0) return std::string(1, "xyz"[axis]) + "0";
    if (a[axis] == grid.cells[axis]) return std::string(1, "xyz"[axis]) + "1";
  }
  return {};
}

}  // namespace

Mesh make_box(const BoxMesh& box) {
  check(box);
  Mesh mesh;
  mesh.nodes = make_nodes(box);
  mesh.cells = box.elements == BoxMesh::Elements::tetrahedra ? Cells(make_tets(box)) : make_cells(box);
  mesh.region_of.assign(mesh.cells.size(), 0);
  mesh.region_names = {"body"};
  for (const FaceCorners& face : boundary_faces(mesh)) mesh.surfaces[side_of({box.cells}, face)].push_back(face);
  return mesh;
}

}  // namespace orthodyn
