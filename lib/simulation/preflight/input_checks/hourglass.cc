// Rows of hexahedra with reduced integration that are one element wide and high: their zero-energy shapes (hourglass)
// pass from element to element, so that the stiffness of such a row is singular even if one end is held. With two
// elements across, neighbours prevent these shapes.

#include <algorithm>
#include <set>
#include <string>

#include "lib/mesh/cell_rows.h"
#include "lib/simulation/preflight/input_checks/check_context.h"

namespace orthodyn::input_checks {

namespace {

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
  if (parts.subdomain) return;
  const std::vector<char> in_row = cells_in_rows(parts.mesh);
  std::set<std::string> told;
  for (const auto& term : parts.elastic) {
    const std::string& region = term->definition().mesh_region;
    if (term->type().shape() != CellShape::hex20 || term->num_points() != quadratic_hexahedron().num_points()) continue;
    const std::vector<int>& cells = term->definition().cells;
    const auto count = std::count_if(cells.begin(), cells.end(), [&](int cell) {
      const auto c = static_cast<std::size_t>(cell);
      return in_row[c] && is_loose(parts, c);
    });
    if (count == 0 || !told.insert(region).second) continue;
    warn(out, context.config.at("regions").where(),
         "region '{}': {} without neighbours in two directions: reduced integration leaves shapes without stiffness "
         "(hourglass), which no neighbour prevents. Remove `integration: reduced`, or use two elements across",
         region, count == 1 ? "1 hexahedron is" : fmt::format("{} hexahedra are", count));
  }
}

}  // namespace orthodyn::input_checks
