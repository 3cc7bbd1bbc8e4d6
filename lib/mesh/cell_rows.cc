#include "lib/mesh/cell_rows.h"

#include <algorithm>
#include <array>

#include "lib/mesh/mesh_faces.h"

namespace orthodyn {

namespace {

// For each of the six faces of a hexahedron (x0, x1, y0, y1, z0, z1), whether another cell lies behind it.
std::array<bool, 6> neighbours(const Mesh& mesh, const std::vector<MeshFace>& faces, std::size_t cell) {
  std::array<bool, 6> found{};
  const auto nodes = mesh.cells[cell];
  for (std::size_t f = 0; f < found.size(); ++f) {
    const std::vector<int>& at = topology(CellShape::hex20).faces[f];
    const auto corner = [&](std::size_t k) { return nodes[static_cast<std::size_t>(at[k])]; };
    const auto [begin, end] = find_faces(faces, {corner(0), corner(1), corner(2), corner(3)});
    found[f] = end > begin + 1;
  }
  return found;
}

bool is_in_row(const std::array<bool, 6>& has_neighbour) {
  int free_directions = 0;
  for (std::size_t direction = 0; direction < 3; ++direction)
    free_directions += !has_neighbour[2 * direction] && !has_neighbour[2 * direction + 1];
  return free_directions >= 2;
}

}  // namespace

std::vector<char> cells_in_rows(const Mesh& mesh) {
  std::vector<char> in_row(mesh.cells.size(), 0);
  const auto& shapes = mesh.cells.shapes();
  if (std::find(shapes.begin(), shapes.end(), CellShape::hex20) == shapes.end()) return in_row;
  const std::vector<MeshFace> faces = sorted_faces(mesh);
  for (std::size_t c = 0; c < mesh.cells.size(); ++c)
    in_row[c] = shapes[c] == CellShape::hex20 && is_in_row(neighbours(mesh, faces, c));
  return in_row;
}

}  // namespace orthodyn
