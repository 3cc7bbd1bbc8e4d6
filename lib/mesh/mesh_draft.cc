#include "lib/mesh/mesh_draft.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <utility>

#include "lib/core/errors.h"
#include "lib/mesh/node_numbers.h"

namespace orthodyn {
namespace {

void sort_by_tag(MeshDraft& draft) {
  std::vector<FileNode>& nodes = draft.nodes;
  if (nodes.size() > static_cast<std::size_t>(std::numeric_limits<int>::max())) {
    draft.fail({}, fmt::format("{} nodes are too many", nodes.size()));
  }
  const auto before = [](const FileNode& a, const FileNode& b) { return a.tag < b.tag; };
  if (!std::is_sorted(nodes.begin(), nodes.end(), before)) std::stable_sort(nodes.begin(), nodes.end(), before);
  const auto same = std::adjacent_find(nodes.begin(), nodes.end(),
                                       [](const FileNode& a, const FileNode& b) { return a.tag == b.tag; });
  if (same == nodes.end()) return;
  draft.fail((same + 1)->place, fmt::format("node tag {} is defined twice (first in line {})", same->tag,
                                            same->place.line));
}

template <std::size_t N>
std::array<int, N> node_numbers(const MeshDraft& draft, const NodeNumbers& number, const auto& element,
                                const std::array<std::int64_t, N>& tags) {
  std::array<int, N> numbers{};
  for (std::size_t i = 0; i < N; ++i) {
    numbers[i] = number(tags[i]);
    if (numbers[i] >= 0) continue;
    draft.fail(element.place, fmt::format("element {}: node {} is not defined in {}", element.tag, tags[i],
                                          draft.nodes_section));
  }
  return numbers;
}

void check_order(const MeshDraft& draft) {
  for (const FileTet& tet : draft.tets)
    if (tet.midsides.has_value() != draft.tets.front().midsides.has_value())
      draft.fail(tet.place, fmt::format("element {} is {}, earlier ones are not; all must be of one order", tet.tag,
                                        tet.midsides ? "quadratic" : "linear"));
}

TetMesh number_nodes(const MeshDraft& draft) {
  const NodeNumbers number(draft.nodes);
  TetMesh mesh;
  mesh.region_names = draft.region_names;
  for (const FileNode& node : draft.nodes) mesh.nodes.push_back(node.x);
  for (const FileTet& tet : draft.tets) {
    mesh.tets.push_back(node_numbers(draft, number, tet, tet.nodes));
    if (tet.midsides) mesh.midsides.push_back(node_numbers(draft, number, tet, *tet.midsides));
    mesh.region_of.push_back(tet.region);
  }
  for (const auto& [name, triangles] : draft.surfaces) {
    auto& surface = mesh.surfaces[name];
    for (const FileTriangle& t : triangles) surface.push_back(node_numbers(draft, number, t, t.nodes));
  }
  for (const auto& [name, uses] : draft.node_sets) {
    auto& set = mesh.node_sets[name];
    for (const FileNodeUse& use : uses) {
      set.push_back(number(use.tag));
      if (set.back() < 0) {
        draft.fail(use.place, fmt::format("node set \"{}\": node {} is not defined in {}", name, use.tag,
                                          draft.nodes_section));
      }
    }
  }
  return mesh;
}

// True if it turned them.
bool turn_if_all_inverted(TetMesh& mesh) {
  const auto inverted = [&](const Tet& tet) { return signed_volume6(mesh, tet) < 0; };
  if (mesh.tets.size() < 2 || !std::all_of(mesh.tets.begin(), mesh.tets.end(), inverted)) return false;
  for (Tet& tet : mesh.tets) std::swap(tet[2], tet[3]);
  for (Midsides& middles : mesh.midsides) {
    std::swap(middles[1], middles[4]);
    std::swap(middles[2], middles[3]);
  }
  return true;
}

MeshOrigin origin_of(const MeshDraft& draft) {
  const auto element_name = [&draft](const auto& element) {
    return fmt::format("{}: element {}", draft.where(element.place), element.tag);
  };
  return {
      .source = draft.files.front(),
      .tet_name = [&draft, element_name](int t) { return element_name(draft.tets[static_cast<std::size_t>(t)]); },
      .node_name =
          [&draft](int n) {
            const FileNode& node = draft.nodes[static_cast<std::size_t>(n)];
            return fmt::format("{}: node {}", draft.where(node.place), node.tag);
          },
      .triangle_name =
          [&draft, element_name](const std::string& surface, int k) {
            return element_name(draft.surfaces.at(surface)[static_cast<std::size_t>(k)]);
          },
  };
}

}  // namespace

int MeshDraft::region_index(const std::string& name) {
  const auto [entry, is_new] = region_indices.emplace(name, static_cast<int>(region_names.size()));
  if (is_new) region_names.push_back(name);
  return entry->second;
}

std::string MeshDraft::where(FilePlace place) const {
  const std::string& file = files[static_cast<std::size_t>(place.file)];
  return place.line > 0 ? fmt::format("{}:{}", file, place.line) : file;
}

void MeshDraft::fail(FilePlace place, const std::string& message) const {
  throw ConfigError(where(place), message);
}

LoadedMesh build_mesh(MeshDraft draft) {
  sort_by_tag(draft);
  check_order(draft);
  LoadedMesh loaded{.mesh = number_nodes(draft), .warnings = std::move(draft.warnings)};
  if (turn_if_all_inverted(loaded.mesh)) {
    loaded.warnings.push_back(fmt::format("{}: all {} elements count their nodes the other way round; they were turned",
                                          draft.files.front(), draft.tets.size()));
  }
  const Warnings found = validate(loaded.mesh, origin_of(draft));
  loaded.warnings.insert(loaded.warnings.end(), found.begin(), found.end());
  return loaded;
}

}  // namespace orthodyn
