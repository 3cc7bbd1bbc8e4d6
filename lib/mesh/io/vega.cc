#include "lib/mesh/io/vega.h"

#include <algorithm>
#include <utility>

#include "lib/mesh/io/text_tokens.h"
#include "lib/mesh/io/vega_file.h"

namespace orthodyn {
namespace {

constexpr const char* kAll = "allElements";

// The *REGIONs in file order. If there are none, the sets, as regions without materials.
std::vector<VegaRegion> regions_or_sets(const VegaFile& file) {
  if (!file.regions.empty()) return file.regions;
  std::vector<VegaRegion> regions;
  for (const VegaSet& set : file.sets) regions.push_back({set.name, "", set.place});
  return regions;
}

const VegaSet* find_set(const VegaFile& file, const std::string& name) {
  const auto found = std::find_if(file.sets.begin(), file.sets.end(), [&](const VegaSet& s) { return s.name == name; });
  return found == file.sets.end() ? nullptr : &*found;
}

std::vector<std::size_t> elements_of(const VegaFile& file, const VegaRegion& region) {
  std::vector<std::size_t> elements;
  const VegaSet* set = find_set(file, region.set);
  if (!set) {
    if (region.set != kAll) file.draft.fail(region.place, "no *SET {}", TextTokens::quoted(region.set));
    for (std::size_t e = 0; e < file.draft.cells.size(); ++e) elements.push_back(e);
    return elements;
  }
  const auto count = static_cast<std::int64_t>(file.draft.cells.size());
  for (const FileNodeUse& use : set->elements) {
    const std::int64_t index = use.tag < 0 ? -1 : use.tag - file.first_element;
    if (index < 0 || index >= count)
      file.draft.fail(use.place, "set {}: element {}; there are {} to {}", TextTokens::quoted(set->name), use.tag,
                      file.first_element, file.first_element + count - 1);
    elements.push_back(static_cast<std::size_t>(index));
  }
  return elements;
}

// The region of each element, an index into `regions`, -1 for none. The last region of an element wins.
std::vector<int> assign_regions(VegaFile& file, const std::vector<VegaRegion>& regions) {
  std::vector<int> region_of(file.draft.cells.size(), -1);
  for (std::size_t r = 0; r < regions.size(); ++r) {
    std::size_t taken = 0;
    for (const std::size_t e : elements_of(file, regions[r])) {
      taken += region_of[e] >= 0 && region_of[e] != static_cast<int>(r);
      region_of[e] = static_cast<int>(r);
    }
    if (taken == 0) continue;
    file.draft.warn(regions[r].place, "region \"{}\" takes {} elements from earlier regions", regions[r].set, taken);
  }
  return region_of;
}

// The material of a region; null for a region without material.
const MeshMaterial* material_of(const VegaFile& file, const VegaRegion& region) {
  if (region.material.empty()) return nullptr;
  const auto found = file.materials.find(region.material);
  if (found == file.materials.end())
    file.draft.fail(region.place, "no *MATERIAL {}", TextTokens::quoted(region.material));
  return &found->second;
}

// Sets the regions of the elements in the draft: "unassigned" for elements in none, or "body" if there are no regions.
void assign_elements(VegaFile& file, const std::vector<int>& region_of, const std::vector<int>& index) {
  const char* rest = index.empty() ? "body" : "unassigned";
  std::size_t unassigned = 0;
  for (std::size_t e = 0; e < region_of.size(); ++e) {
    const int r = region_of[e];
    file.draft.cells[e].region = r < 0 ? file.draft.region_index(rest) : index[static_cast<std::size_t>(r)];
    unassigned += r < 0;
  }
  if (unassigned == 0 || index.empty()) return;
  file.draft.warn({}, "{} of {} elements are in no region; they are in region \"unassigned\"", unassigned,
                  region_of.size());
}

void warn_of_unused_sets(VegaFile& file) {
  if (file.regions.empty()) return;
  for (const VegaSet& set : file.sets) {
    const auto names_it = [&](const VegaRegion& region) { return region.set == set.name; };
    if (std::any_of(file.regions.begin(), file.regions.end(), names_it)) continue;
    file.draft.warn(set.place, "*SET {} of {} elements is in no *REGION, and is left out", TextTokens::quoted(set.name),
                    set.elements.size());
  }
}

// Adds the regions to the draft and returns their materials. Regions without elements are dropped.
std::map<std::string, MeshMaterial> add_regions(VegaFile& file) {
  const std::vector<VegaRegion> regions = regions_or_sets(file);
  const std::vector<int> region_of = assign_regions(file, regions);
  std::vector<char> used(regions.size(), false);
  for (const int r : region_of)
    if (r >= 0) used[static_cast<std::size_t>(r)] = true;
  std::map<std::string, MeshMaterial> materials;
  std::vector<int> index(regions.size(), -1);  // index in the draft of each region
  for (std::size_t r = 0; r < regions.size(); ++r) {
    const std::string& set = regions[r].set;
    const MeshMaterial* material = material_of(file, regions[r]);
    if (!used[r]) {
      file.draft.warn(regions[r].place, "region \"{}\" has no elements", set);
      continue;
    }
    index[r] = file.draft.region_index(set);
    if (material) materials[set] = *material;
  }
  assign_elements(file, region_of, index);
  return materials;
}

LoadedMesh build_vega_mesh(VegaFile& file, FileCells cells) {
  if (file.draft.cells.empty()) file.draft.fail({}, "no elements");
  auto materials = add_regions(file);
  warn_of_unused_sets(file);
  LoadedMesh loaded = build_mesh(std::move(file.draft), cells);
  loaded.materials = std::move(materials);
  return loaded;
}

// The list counts vertices from 1.
void add_fixed(const FixedVertices& fixed, VegaFile& file) {
  const std::string text = read_text_file(fixed.path);
  TextTokens tokens(fixed.path, text, {.commas = true, .comment = "#"});
  const int number = static_cast<int>(file.draft.files.size());
  file.draft.files.push_back(fixed.path);
  auto& set = file.draft.node_sets[fixed.set];
  const std::int64_t first = file.draft.nodes.empty() ? 1 : file.draft.nodes.front().tag;
  const auto count = static_cast<std::int64_t>(file.draft.nodes.size());
  while (!tokens.at_end()) {
    const FilePlace place{tokens.line(), number};
    while (tokens.peek() != '\0') {
      const std::int64_t vertex = tokens.integer("a vertex");
      if (vertex < 1 || vertex > count) tokens.fail("vertex {}; the mesh has 1 to {}", vertex, count);
      set.push_back({vertex - 1 + first, place});
    }
    tokens.skip_line();
  }
  if (set.empty()) tokens.fail("no vertices");
}

const bool vega_registered = register_mesh_format({.name = "Vega",
                                                   .endings = {".veg"},
                                                   .read = read_vega,
                                                   .write = write_vega,
                                                   .brings_materials = true,
                                                   .holds_materials = true,
                                                   .holds_surfaces = false});

}  // namespace

LoadedMesh read_vega(const std::string& path, FileCells cells) {
  return read_vega_text(path, read_text_file(path), cells);
}

LoadedMesh read_vega_text(const std::string& path, std::string_view text, FileCells cells) {
  VegaFile file = read_vega_sections(path, text);
  return build_vega_mesh(file, cells);
}

LoadedMesh read_vega(const std::string& path, const FixedVertices& fixed, FileCells cells) {
  VegaFile file = read_vega_sections(path, read_text_file(path));
  add_fixed(fixed, file);
  return build_vega_mesh(file, cells);
}

}  // namespace orthodyn
