#include "lib/mesh/io/abaqus.h"

#include <map>
#include <utility>

#include "lib/core/spelling.h"
#include "lib/mesh/io/abaqus_axes.h"
#include "lib/mesh/io/abaqus_layups.h"
#include "lib/mesh/io/abaqus_regions.h"
#include "lib/mesh/io/abaqus_surfaces.h"
#include "lib/mesh/io/text_tokens.h"

namespace orthodyn {
namespace {

void check_has_solids(const AbaqusFile& file) {
  if (!file.draft.cells.empty()) return;
  const std::string flat =
      file.faces.empty()
          ? ""
          : fmt::format(": {} plane or shell elements alone are a 2D mesh or a surface; mesh the volume inside",
                        file.faces.size());
  file.draft.fail({}, "no solid elements (C3D4, C3D8, C3D6, ...){}", flat);
}

// Material axes of each cell: those of its section's orientation, or the identity; empty if no section has one.
std::vector<Mat3> axes_of_cells(const AbaqusFile& file, AbaqusLookup& lookup, const AbaqusRegions& regions) {
  std::vector<Mat3> axes;
  std::map<std::string, AbaqusAxes> known;
  for (std::size_t c = 0; c < file.draft.cells.size(); ++c) {
    const AbaqusSection* section = regions.section_of_cell[c];
    if (!section || section->orientation.empty()) continue;
    if (axes.empty()) axes.assign(file.draft.cells.size(), Mat3::Identity());
    auto found = known.find(section->orientation);
    if (found == known.end()) {
      const AbaqusOrientation* orientation = find_abaqus(file.orientations, section->orientation);
      if (!orientation)
        file.draft.fail(section->elements.place, "*SOLID SECTION: no *ORIENTATION {}",
                        TextTokens::quoted(section->orientation));
      found = known.emplace(section->orientation, AbaqusAxes(file, *orientation, lookup)).first;
    }
    axes[c] = found->second.of(c, centre_of(file.draft.cells[c], lookup));
  }
  return axes;
}

// Stores axes 1 and 2 of each cell as cell data.
void add_axes(const std::vector<Mat3>& axes, LoadedMesh& loaded) {
  const Mesh& mesh = loaded.mesh;
  CellData first{.name = "axis_1", .components = 3}, second{.name = "axis_2", .components = 3};
  for (std::size_t e = 0; e < mesh.cells.size(); ++e) {
    const Mat3& Q = axes[mesh.cell_of.empty() ? e : static_cast<std::size_t>(mesh.cell_of[e])];
    first.values.insert(first.values.end(), Q.col(0).begin(), Q.col(0).end());
    second.values.insert(second.values.end(), Q.col(1).begin(), Q.col(1).end());
  }
  loaded.cell_data = {std::move(first), std::move(second)};
}

MeshMaterial material_of(const AbaqusFile& file, const AbaqusSection& section) {
  MeshMaterial material = abaqus_material(file, section.material, section.elements.place);
  if (!section.orientation.empty()) material.axes_file = file.draft.files.front();
  return material;
}

LoadedMesh build_abaqus_mesh(AbaqusFile file, FileCells cells) {
  check_has_solids(file);
  complete_composites(file);
  AbaqusLookup lookup(file);
  const AbaqusRegions regions = add_abaqus_regions(file, lookup);
  add_abaqus_surfaces(file, lookup);
  for (const auto& [key, set] : file.node_sets) {
    auto& uses = file.draft.node_sets[set.name];
    for (const FileNodeUse& use : lookup.nodes_of(set)) uses.push_back(use);
  }
  for (const auto& [key, set] : file.element_sets)
    if (const std::size_t missing = lookup.count_undefined(set); missing > 0)
      file.draft.warn({}, "element set \"{}\" lists {} that no *ELEMENT defines", set.name,
                      counted(static_cast<long>(missing), "element"));
  const std::vector<Mat3> axes = axes_of_cells(file, lookup, regions);
  std::map<std::string, MeshMaterial> materials;
  for (const auto& [name, section] : regions.section_of_region)
    if (!section->material.empty()) materials.emplace(name, material_of(file, *section));
  auto plies = layups_of_regions(file, lookup, regions, axes);
  std::map<std::string, MeshLayup> layups;
  for (auto& [name, own] : plies)
    layups[name] = {std::move(own),
                    regions.section_of_region.at(name)->orientation.empty() ? "" : file.draft.files.front()};
  LoadedMesh loaded = build_mesh(std::move(file.draft), cells);
  loaded.materials = std::move(materials);
  loaded.layups = std::move(layups);
  if (!axes.empty()) add_axes(axes, loaded);
  return loaded;
}

const bool abaqus_registered = register_mesh_format(
    {.name = "Abaqus", .endings = {".inp"}, .read = read_abaqus, .write = write_abaqus, .brings_materials = true});

}  // namespace

LoadedMesh read_abaqus(const std::string& path, FileCells cells) {
  return read_abaqus_text(path, read_text_file(path), cells);
}

LoadedMesh read_abaqus_text(const std::string& path, std::string_view text, FileCells cells) {
  return build_abaqus_mesh(read_abaqus_keywords(path, text), cells);
}

}  // namespace orthodyn
