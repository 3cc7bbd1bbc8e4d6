#include "lib/mesh/io/abaqus_scene.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <set>
#include <vector>

#include "lib/core/words.h"
#include "lib/mesh/io/abaqus.h"
#include "lib/mesh/io/abaqus_file.h"
#include "lib/mesh/io/mesh_format.h"
#include "lib/mesh/io/text_tokens.h"

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

// The constants of one row, of which a line holds eight; a temperature may follow. Empty if there are several rows.
std::vector<double> constants(const std::vector<std::vector<double>>& lines, std::size_t count) {
  std::vector<double> out;
  if (lines.empty() || lines.size() > (count + 7) / 8) return {};
  for (std::size_t l = 0; l < lines.size(); ++l) {
    out.insert(out.end(), lines[l].begin(), lines[l].end());
    if (l + 1 < lines.size()) out.resize(8 * (l + 1));
  }
  if (out.size() > count + 1) return {};
  out.resize(count);
  return out;
}

// Names of the entries of C, in Abaqus' own indices 1 to 6 = 11, 22, 33, 12, 13, 23.
constexpr std::array<const char*, 9> kOrthotropic{"c11", "c12", "c22", "c13", "c23", "c33", "c44", "c55", "c66"};
constexpr std::array<const char*, 21> kAnisotropic{"c11", "c12", "c22", "c13", "c23", "c33", "c14",
                                                   "c24", "c34", "c44", "c15", "c25", "c35", "c45",
                                                   "c55", "c16", "c26", "c36", "c46", "c56", "c66"};

std::string stiffness(const auto& names, const std::vector<double>& values) {
  std::string text = "type: anisotropic, voigt_order: abaqus";
  for (std::size_t k = 0; k < names.size(); ++k) text += fmt::format(", {}: {}", names[k], values[k]);
  return text;
}

// The keys of a material, or "" with the reason why there are none.
std::string elasticity(const AbaqusMaterial& m, std::string& problem) {
  const auto is = [&](const char* type) { return std::string_view(type).starts_with(m.type); };
  const auto read = [&](std::size_t count) {
    const auto values = constants(m.elastic, count);
    if (values.empty()) problem = fmt::format("*ELASTIC is not one set of {} constants", count);
    return values;
  };
  if (m.elastic.empty()) {
    problem = "it has no *ELASTIC";
  } else if (m.type.empty() || is("ISOTROPIC")) {
    if (const auto c = read(2); !c.empty()) return fmt::format("type: isotropic, young: {}, nu: {}", c[0], c[1]);
  } else if (is("ENGINEERINGCONSTANTS")) {
    if (const auto c = read(9); !c.empty())
      return fmt::format(
          "type: orthotropic, young: [{}, {}, {}], nu12: {}, nu13: {}, nu23: {}, g12: {}, g13: {}, g23: {}", c[0], c[1],
          c[2], c[3], c[4], c[5], c[6], c[7], c[8]);
  } else if (is("ORTHOTROPIC")) {
    if (const auto c = read(9); !c.empty()) return stiffness(kOrthotropic, c);
  } else if (is("ANISOTROPIC")) {
    if (const auto c = read(21); !c.empty()) return stiffness(kAnisotropic, c);
  } else {
    problem = fmt::format("*ELASTIC, TYPE={} is not read", m.type);
  }
  return "";
}

std::string material_line(const AbaqusMaterial& m) {
  std::string problem = m.problem;
  const std::string keys = problem.empty() ? elasticity(m, problem) : "";
  const bool has_density = m.density.size() == 1 && !m.density[0].empty();
  if (problem.empty() && !has_density) problem = "it has no *DENSITY, or several";
  if (!problem.empty()) return fmt::format("  # {}: {}; give it here\n", yaml_name(m.name), problem);
  return fmt::format("  {}: {{density: {}, {}}}\n", yaml_name(m.name), m.density[0][0], keys);
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
  for (const auto& [key, material] : deck.materials) text += material_line(material);
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
  std::set<std::string> others = deck.skipped;
  for (const char* read : {"*MATERIAL", "*ELASTIC", "*DENSITY"}) others.erase(read);
  return text + list("left out", {others.begin(), others.end()});
}

}  // namespace orthodyn
