#include "lib/scene/abaqus_scene.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <set>
#include <vector>

#include "lib/core/words.h"
#include "lib/mesh/io/abaqus.h"
#include "lib/mesh/io/abaqus_file.h"
#include "lib/mesh/io/mesh_format.h"
#include "lib/mesh/io/text_tokens.h"
#include "lib/scene/mesh_materials.h"

namespace orthodyn {
namespace {

std::string yaml_name(const std::string& name) {
  const auto plain = [](unsigned char c) { return std::isalnum(c) || c == '_'; };
  if (!name.empty() && std::isalpha(static_cast<unsigned char>(name[0])) &&
      std::all_of(name.begin(), name.end(), plain))
    return name;
  std::string quoted = "\"";
  for (const char c : name) quoted += c == '"' || c == '\\' ? std::string("\\") + c : std::string(1, c);
  return quoted + "\"";
}

std::string material_line(const MeshMaterial& m) {
  if (!m.problem.empty()) return fmt::format("  # {}: {}; give it here\n", yaml_name(m.name), m.problem);
  std::string beyond;
  for (const auto& [where, name] : m.beyond) beyond += fmt::format("{}{}", beyond.empty() ? "   # without " : ", ", name);
  return fmt::format("  {}: {}{}\n", yaml_name(m.name), material_yaml(m), beyond);
}

std::string list(const char* what, std::vector<std::string> names) {
  return names.empty() ? "" : fmt::format("# {}: {}\n", what, join(names));
}

}  // namespace

std::string scene_of_abaqus(const std::string& path, const std::string& file) {
  const std::string content = read_text_file(path);
  const AbaqusFile deck = read_abaqus_keywords(path, content);
  const LoadedMesh loaded = read_abaqus_text(path, content);
  std::string text = fmt::format("mesh: {{type: file, file: {}}}   # scale: 0.001 if it is in mm\n\n", yaml_name(file));
  text += "# As in the file. orthodyn computes in Pa and kg/m^3: of a file in N, mm and t, multiply moduli by 1e6 and densities\n"
          "# by 1e12.\nmaterials:\n";
  for (const auto& [key, material] : deck.materials) text += material_line(mesh_material(material, deck.draft));
  text += "\nregions:\n";
  std::set<std::string> named;
  for (const AbaqusSection& section : deck.sections) {
    const AbaqusSet* set = find_abaqus(deck.element_sets, section.elements.set);
    const auto& regions = loaded.mesh.region_names;
    if (!set || std::find(regions.begin(), regions.end(), set->name) == regions.end()) continue;
    if (!named.insert(set->name).second) continue;
    const auto material = deck.materials.find(section.material);
    text += fmt::format("  {}: {{material: {}{}}}\n", yaml_name(set->name),
                        yaml_name(material == deck.materials.end() ? section.material : material->second.name),
                        section.orientation.empty() ? "" : fmt::format(", axes: {{type: file, file: {}}}", yaml_name(file)));
  }
  for (const std::string& region : loaded.mesh.region_names)
    if (!named.contains(region)) text += fmt::format("  # {}: {{material: }}, has no section\n", yaml_name(region));
  text += "\n# What the file has beside, for clamps, loads and probes.\n";
  text += list("surfaces", names_of(loaded.mesh.surfaces)) + list("node sets", names_of(loaded.mesh.node_sets));
  return text + list("left out", {deck.skipped.begin(), deck.skipped.end()});
}

}  // namespace orthodyn
