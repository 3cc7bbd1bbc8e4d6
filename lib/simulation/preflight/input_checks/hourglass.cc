// Rows of hexahedra with reduced integration that are one element wide and high: their zero-energy shapes (hourglass)
// pass from element to element, so that the stiffness of such a row is singular even if one end is held. With two
// elements across, neighbours prevent these shapes.

#include <algorithm>
#include <array>

#include "lib/mesh/mesh_faces.h"
#include "lib/simulation/preflight/input_checks/check_context.h"

namespace orthodyn::input_checks {

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

// Whether the cell has no neighbour in two of its three directions.
bool is_in_row(const std::array<bool, 6>& has_neighbour) {
  int free_directions = 0;
  for (std::size_t direction = 0; direction < 3; ++direction)
    free_directions += !has_neighbour[2 * direction] && !has_neighbour[2 * direction + 1];
  return free_directions >= 2;
}

// Whether at most one face of the cell is held, with all its nodes.
bool is_loose(const FemModel::Parts& parts, std::size_t cell) {
  const auto nodes = parts.mesh.cells[cell];
  const auto is_held = [&](int place) {
    const auto& dofs = parts.dofs->node(nodes[static_cast<std::size_t>(place)]);
    return std::all_of(dofs.begin(), dofs.end(), [](int dof) { return dof < 0; });
  };
  const auto& faces = topology(CellShape::hex20).faces;
  return std::count_if(faces.begin(), faces.end(), [&](const std::vector<int>& face) {
           return std::all_of(face.begin(), face.end(), is_held);
         }) <= 1;
}

}  // namespace

void check_hourglass(const CheckContext& context, Warnings& out) {
  const FemModel::Parts& parts = context.built.model->parts();
  const Mesh& mesh = parts.mesh;
  const auto& shapes = mesh.cells.shapes();
  if (parts.subdomain || std::find(shapes.begin(), shapes.end(), CellShape::hex20) == shapes.end()) return;
  const std::vector<MeshFace> faces = sorted_faces(mesh);
  int count = 0;
  for (std::size_t c = 0; c < mesh.cells.size(); ++c)
    count += shapes[c] == CellShape::hex20 && is_in_row(neighbours(mesh, faces, c)) && is_loose(parts, c);
  if (count == 0) return;
  warn(
      out, context.config.at("mesh").where(),
      "{} without neighbours in two directions: reduced integration leaves shapes without stiffness (hourglass), which "
      "no neighbour prevents. Use at least two elements across, or tetrahedra (`elements: tetrahedra`; of a file "
      "`split: true`)",
      count == 1 ? "1 hexahedron is" : fmt::format("{} hexahedra are", count));
}

}  // namespace orthodyn::input_checks
