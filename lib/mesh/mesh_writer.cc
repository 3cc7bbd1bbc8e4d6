#include "lib/mesh/mesh_writer.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace orthodyn {

void note_loss(WrittenMesh& written, const std::string& what, const std::vector<std::string>& names) {
  if (names.empty()) return;
  written.losses.push_back(fmt::format("the format cannot hold {}: lost {}", what, fmt::join(names, ", ")));
}

void note_lost_materials_and_data(WrittenMesh& written, const LoadedMesh& loaded) {
  note_loss(written, "materials", names_of(loaded.materials));
  std::vector<std::string> arrays;
  for (const CellData& data : loaded.cell_data) {
    if (data.name != "region") arrays.push_back(data.name);  // its numbers are the regions themselves
  }
  note_loss(written, "values per element", arrays);
}

}  // namespace orthodyn
