#include "lib/mesh/loaded_mesh.h"

namespace orthodyn {

const CellData* find_cell_data(const LoadedMesh& loaded, const std::string& name) {
  for (const CellData& data : loaded.cell_data) {
    if (data.name == name) return &data;
  }
  return nullptr;
}

}  // namespace orthodyn
