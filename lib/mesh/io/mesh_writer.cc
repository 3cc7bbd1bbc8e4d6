#include "lib/mesh/io/mesh_writer.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cctype>

namespace orthodyn {

void note_loss(WrittenMesh& written, const std::string& what, const std::vector<std::string>& names) {
  if (names.empty()) return;
  written.losses.push_back(fmt::format("the format cannot hold {}: lost {}", what, fmt::join(names, ", ")));
}

std::string unique_name(TakenNames& taken, const std::string& name, const std::string& cleaned, WrittenMesh& written) {
  const auto take = [&](std::string key) {
    if (!taken.capitals_differ) {
      for (char& c : key) c = static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
    }
    return taken.names.insert(std::move(key)).second;
  };
  std::string out = cleaned.empty() ? "unnamed" : cleaned;
  for (int k = 2; !take(out); ++k) out = fmt::format("{}_{}", cleaned.empty() ? "unnamed" : cleaned, k);
  if (out != name) written.losses.push_back(fmt::format("the name \"{}\" became \"{}\"", name, out));
  return out;
}

void note_lost_materials_and_data(WrittenMesh& written, const LoadedMesh& loaded) {
  note_loss(written, "the materials of regions", names_of(loaded.materials));
  std::vector<std::string> arrays;
  for (const CellData& data : loaded.cell_data) {
    if (data.name != "region") arrays.push_back(data.name);  // its numbers are the regions themselves
  }
  note_loss(written, "values per element", arrays);
}

}  // namespace orthodyn
