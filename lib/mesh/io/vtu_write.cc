// A mesh as .vtu file.
#include <utility>

#include "lib/mesh/io/vtk_grid.h"
#include "lib/mesh/io/vtu.h"
#include "lib/mesh/io/vtu_text.h"

namespace orthodyn {
namespace {

VtuArray membership(const std::string& name, const std::vector<int>& nodes, std::size_t num_nodes) {
  VtuArray inside{.name = "nodes:" + name, .type = VtuNumber::uint8, .values = std::vector<double>(num_nodes, 0)};
  for (const int n : nodes) inside.values[static_cast<std::size_t>(n)] = 1;
  return inside;
}

}  // namespace

WrittenMesh write_vtu(const LoadedMesh& loaded) {
  const TetMesh& mesh = loaded.mesh;
  VtuGrid grid{.points = mesh.nodes, .cell_type = kVtkTetra, .points_per_cell = 4, .connectivity = {}};
  for (const Tet& tet : mesh.tets) grid.connectivity.insert(grid.connectivity.end(), tet.begin(), tet.end());
  for (const auto& [name, nodes] : mesh.node_sets) grid.point_data.push_back(membership(name, nodes, mesh.nodes.size()));
  grid.cell_data.push_back(
      {.name = "region", .type = VtuNumber::int32, .values = {mesh.region_of.begin(), mesh.region_of.end()}});
  for (const CellData& data : loaded.cell_data) {
    if (data.name != "region") grid.cell_data.push_back({.name = data.name, .components = data.components, .values = data.values});
  }
  grid.region_names = mesh.region_names;
  return {.files = {{".vtu", std::move(vtu_text(grid, VtuStorage::ascii).front())}}};
}

}  // namespace orthodyn
