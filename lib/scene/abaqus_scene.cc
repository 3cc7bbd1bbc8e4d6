#include "lib/scene/abaqus_scene.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <set>
#include <tuple>

#include "lib/config/values.h"
#include "lib/core/spelling.h"
#include "lib/mesh/io/abaqus.h"
#include "lib/mesh/io/mesh_format.h"
#include "lib/mesh/io/text_tokens.h"
#include "lib/scene/abaqus_conditions.h"
#include "lib/scene/mesh_materials.h"

namespace orthodyn {
namespace {

bool can_be_taken(const LoadedMesh& loaded) {
  bool all_can_be_taken = true;
  for_each_material(loaded, [&](const std::string&, const MeshMaterial& m) {
    all_can_be_taken = all_can_be_taken && m.problem.empty() && m.beyond.empty();
  });
  return std::all_of(loaded.mesh.region_names.begin(), loaded.mesh.region_names.end(),
                     [&](const std::string& region) {
                       return loaded.materials.contains(region) || loaded.layups.contains(region);
                     }) &&
         all_can_be_taken;
}

// Comments that list the materials; the scene itself reads them from the mesh file.
std::string materials_in_comments(const LoadedMesh& loaded) {
  std::string text =
      "# Materials and axes come from the mesh file. Sections `materials` and `regions` in this scene replace them.\n";
  for (const auto& [region, m] : loaded.materials)
    text += fmt::format("#   {}: {} {}{}\n", region, m.name, material_yaml(m),
                        m.axes_file.empty() ? "" : ", axes by its orientation");
  for (const auto& [region, layup] : loaded.layups)
    text += fmt::format("#   {}: layup {}{}\n", region, layup_yaml(layup),
                        layup.axes_file.empty() ? "" : ", axes by its orientation");
  return text;
}

std::string material_entry(const MeshMaterial& m) {
  if (!m.problem.empty()) return fmt::format("  # {}: {}; give it here\n", yaml_name(m.name), m.problem);
  std::string beyond;
  for (const auto& [where, name] : m.beyond)
    beyond += fmt::format("{}{}", beyond.empty() ? "   # without " : ", ", name);
  return fmt::format("  {}: {}{}\n", yaml_name(m.name), material_yaml(m), beyond);
}

std::string typed_materials(const LoadedMesh& loaded, const std::string& file) {
  std::map<std::string, const MeshMaterial*> by_name;
  for_each_material(loaded, [&](const std::string&, const MeshMaterial& m) { by_name[m.name] = &m; });
  std::string text = "materials:\n";
  for (const auto& [name, m] : by_name) text += material_entry(*m);
  text += "\nregions:\n";
  const auto axes_of = [&](const std::string& axes_file) {
    return axes_file.empty() ? "" : fmt::format(", axes: {{type: file, file: {}}}", yaml_name(file));
  };
  for (const std::string& region : loaded.mesh.region_names) {
    if (const auto layup = loaded.layups.find(region); layup != loaded.layups.end()) {
      text += fmt::format("  {}: {{layup: {}{}}}\n", yaml_name(region), layup_yaml(layup->second),
                          axes_of(layup->second.axes_file));
      continue;
    }
    const auto m = loaded.materials.find(region);
    if (m == loaded.materials.end()) {
      text += fmt::format("  # {}: {{material: }}, has no section\n", yaml_name(region));
      continue;
    }
    text += fmt::format("  {}: {{material: {}{}}}\n", yaml_name(region), yaml_name(m->second.name),
                        axes_of(m->second.axes_file));
  }
  return text;
}

std::string yaml_list(const char* key, const std::vector<std::string>& entries) {
  if (entries.empty()) return "";
  std::string text = fmt::format("\n{}:\n", key);
  for (const std::string& entry : entries) text += "  - " + entry + "\n";
  return text;
}

std::string conditions_text(const SceneConditions& conditions) {
  std::string text;
  if (conditions.is_linear) text += "\nelasticity: {kinematics: linear}   # a *STEP without NLGEOM\n";
  if (!conditions.gravity.empty()) text += fmt::format("\ngravity: {}\n", conditions.gravity);
  text += yaml_list("clamps", conditions.clamps) + yaml_list("motions", conditions.motions) +
          yaml_list("loads", conditions.loads) + yaml_list("terms", conditions.terms);
  if (conditions.clamps.empty() && conditions.motions.empty())
    text += "\n# clamps:\n#   - nodes: NAME            # or surface: NAME\n";
  if (conditions.loads.empty() && conditions.terms.empty() && conditions.gravity.empty())
    text += "\n# loads:\n#   - surface: NAME\n#     force: [0, 0, -5]      # N in total\n";
  return text;
}

// The times of amplitude tables count from the start of the first step.
std::string time_text(const SceneConditions& conditions, bool is_static) {
  if (!conditions.end) return "";
  const std::string end = number_text(*conditions.end);
  if (!is_static) return fmt::format("\n# The first step of the file ends at {} s.\n", end);
  return fmt::format("\ntime: {{end: {}}}   # s, end of the first step, where statics evaluate all factors\n", end);
}

// What was not converted. Conditions are not included, because they have their own list.
std::vector<std::string> others_left_out(const AbaqusFile& deck, const LoadedMesh& loaded) {
  std::vector<std::string> names;
  for (const auto& [what, place] : deck.skipped) {
    static const std::set<std::string> told{"*AMPLITUDE", "*BOUNDARY", "*CLOAD",   "*DLOAD",
                                            "*DSLOAD",    "*STEP",     "*END STEP"};
    if (!told.contains(what)) names.push_back(place.line > 0 ? fmt::format("{} (line {})", what, place.line) : what);
  }
  std::set<std::string> used;
  for_each_material(loaded, [&](const std::string&, const MeshMaterial& m) {
    used.insert(in_capitals(m.name));
    for (const auto& [where, name] : m.beyond)
      names.push_back(fmt::format("{} of material {} ({})", name, m.name, where));
    if (!m.without_effect.empty())
      names.push_back(fmt::format("of material {}, not used by orthodyn: {}", m.name, join(m.without_effect)));
  });
  for (const auto& [key, material] : deck.materials)
    if (!used.contains(key))
      names.push_back(fmt::format("*MATERIAL {} (line {}): not used by a section", material.name, material.place.line));
  return names;
}

std::string comment(const char* what, const std::vector<std::string>& names) {
  return names.empty() ? "" : fmt::format("# {}: {}\n", what, join(names));
}

// Names in the mesh: those of the file or, if `made`, those made for node and face numbers in conditions.
template <class Thing>
std::vector<std::string> names_in(const auto& in_mesh, const std::map<std::string, Thing>& things, bool made) {
  std::set<std::string> of_conditions;
  for (const auto& [key, thing] : things)
    if (thing.of_condition) of_conditions.insert(thing.name);
  std::vector<std::string> names = names_of(in_mesh);
  std::erase_if(names, [&](const std::string& name) { return of_conditions.contains(name) != made; });
  return names;
}

std::string names_in_comments(const AbaqusFile& deck, const LoadedMesh& loaded) {
  const auto& [surfaces, node_sets] = std::tie(loaded.mesh.surfaces, loaded.mesh.node_sets);
  std::vector<std::string> made = names_in(surfaces, deck.surfaces, true);
  for (auto& name : names_in(node_sets, deck.node_sets, true)) made.push_back(std::move(name));
  return "\n# Names in the file, for clamps, loads and probes.\n" +
         comment("surfaces", names_in(surfaces, deck.surfaces, false)) +
         comment("node sets", names_in(node_sets, deck.node_sets, false)) +
         comment("made from nodes and faces that conditions list by number", made);
}

}  // namespace

AbaqusScene scene_of_abaqus(const std::string& path, const std::string& file, const AbaqusSceneOptions& options) {
  const std::string content = read_text_file(path);
  const AbaqusFile deck = read_abaqus_keywords(path, content);
  LoadedMesh loaded = read_abaqus_text(path, content);
  // Plies bend: linear elements would be too stiff.
  const std::string order = !loaded.layups.empty() && loaded.mesh.order() == 1 ? ", order: 2" : "";
  convert_to_si(loaded, options.units, path);
  const SceneConditions conditions = conditions_of(deck, loaded, options);
  AbaqusScene scene;
  scene.text = options.units == FileUnits::si
                   ? fmt::format("mesh: {{type: file, file: {}{}}}   # units: mm_t_s if it is in mm, N and MPa\n\n",
                                 yaml_name(file), order)
                   : fmt::format("mesh: {{type: file, file: {}{}, units: mm_t_s}}\n\n", yaml_name(file), order);
  scene.text += can_be_taken(loaded) ? materials_in_comments(loaded) : typed_materials(loaded, file);
  scene.text += conditions_text(conditions) + time_text(conditions, options.is_static);
  scene.text += names_in_comments(deck, loaded);
  scene.left_out = others_left_out(deck, loaded);
  scene.left_out.insert(scene.left_out.end(), conditions.left_out.begin(), conditions.left_out.end());
  if (!scene.left_out.empty()) scene.text += "\n# Left out of the file:\n";
  for (const std::string& what : scene.left_out) scene.text += "#   " + what + "\n";
  return scene;
}

}  // namespace orthodyn
