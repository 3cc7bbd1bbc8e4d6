#include "lib/mesh/io/mesh_format.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <utility>

#include "lib/core/errors.h"
#include "lib/core/spelling.h"
#include "lib/mesh/io/text_tokens.h"

namespace orthodyn {
namespace {

std::vector<MeshFormat>& table() {
  static std::vector<MeshFormat> formats;
  return formats;
}

std::string ending_of(const std::string& path) {
  std::string ending = std::filesystem::path(path).extension().string();
  for (char& c : ending) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return ending;
}

}  // namespace

bool register_mesh_format(MeshFormat format) {
  const auto by_name = [](const MeshFormat& a, const MeshFormat& b) { return a.name < b.name; };
  table().insert(std::upper_bound(table().begin(), table().end(), format, by_name), std::move(format));
  return true;
}

const std::vector<MeshFormat>& mesh_formats() { return table(); }

std::string known_mesh_endings() {
  std::vector<std::string> known;
  for (const MeshFormat& format : mesh_formats())
    for (const std::string& ending : format.endings) known.push_back(ending + " (" + format.name + ")");
  return join(known);
}

namespace {

const MeshFormat* find_format(const std::string& path) {
  for (const MeshFormat& format : mesh_formats())
    if (std::count(format.endings.begin(), format.endings.end(), ending_of(path)) > 0) return &format;
  return nullptr;
}

std::string unknown_ending(const std::string& path) {
  return fmt::format("no mesh format has the ending \"{}\"; known: {}", ending_of(path), known_mesh_endings());
}

}  // namespace

const MeshFormat& mesh_format_of(const std::string& path) {
  if (const MeshFormat* format = find_format(path)) return *format;
  throw ConfigError(
      path, fmt::format("{}. meshio (apt install python3-meshio) converts some other formats, without the names of "
                        "sets: python3 -c \"import meshio; meshio.write('{}', meshio.read('{}'))\"",
                        unknown_ending(path), std::filesystem::path(path).replace_extension(".vtu").string(), path));
}

const MeshFormat& mesh_format_to_write(const std::string& path) {
  if (const MeshFormat* format = find_format(path)) return *format;
  throw ConfigError(path, unknown_ending(path));
}

Warnings losses_in(const MeshFormat& format, const LoadedMesh& loaded) {
  Warnings losses;
  if (!format.holds_surfaces) note_loss(losses, "surfaces", names_of(loaded.mesh.surfaces));
  if (!format.holds_materials) note_loss(losses, "the materials of regions", names_of(loaded.materials));
  note_loss(losses, "the plies of regions", names_of(loaded.layups));
  if (!format.holds_cell_data) {
    std::vector<std::string> arrays;
    for (const CellData& data : loaded.cell_data) {
      if (data.name != "region") arrays.push_back(data.name);  // "region" holds the numbers of the regions
    }
    note_loss(losses, "values per element", arrays);
  }
  return losses;
}

void note_loss(Warnings& losses, const std::string& what, const std::vector<std::string>& names) {
  if (!names.empty()) losses.push_back("the format cannot hold " + what + ": lost " + join(names));
}

std::string unique_name(TakenNames& taken, const std::string& name, const std::string& cleaned, Warnings& losses) {
  const auto take = [&](const std::string& key) {
    return taken.names.insert(taken.capitals_differ ? key : in_capitals(key)).second;
  };
  const std::string start = cleaned.empty() ? "unnamed" : cleaned;
  std::string out = start;
  for (int k = 2; !take(out); ++k) out = start + "_" + std::to_string(k);
  if (out != name) losses.push_back("the name \"" + name + "\" became \"" + out + "\"");
  return out;
}

}  // namespace orthodyn
