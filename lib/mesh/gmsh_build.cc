#include "lib/mesh/gmsh_build.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstdlib>
#include <limits>
#include <map>
#include <string>
#include <utility>
#include <vector>

namespace orthodyn {
namespace {

// Node tags may be sparse and in any order. Nodes are numbered by ascending tag.
class NodeNumbers {
 public:
  explicit NodeNumbers(const std::vector<GmshNode>& sorted) : sorted_(sorted) {
    if (sorted.empty()) return;
    first_ = static_cast<std::uint64_t>(sorted.front().tag);
    const std::uint64_t range = static_cast<std::uint64_t>(sorted.back().tag) - first_;
    if (range / 4 > sorted.size()) return;
    table_.assign(range + 1, -1);
    for (std::size_t n = 0; n < sorted.size(); ++n) {
      table_[static_cast<std::uint64_t>(sorted[n].tag) - first_] = static_cast<int>(n);
    }
  }

  // -1 if there is no such node.
  int operator()(std::int64_t tag) const {
    if (!table_.empty()) {
      const std::uint64_t offset = static_cast<std::uint64_t>(tag) - first_;
      return offset < table_.size() ? table_[offset] : -1;
    }
    const auto before = [](const GmshNode& node, std::int64_t t) { return node.tag < t; };
    const auto found = std::lower_bound(sorted_.begin(), sorted_.end(), tag, before);
    return found != sorted_.end() && found->tag == tag ? static_cast<int>(found - sorted_.begin())
                                                       : -1;
  }

 private:
  const std::vector<GmshNode>& sorted_;
  std::uint64_t first_ = 0;  // unsigned, so that no difference of tags overflows
  std::vector<int> table_;   // for tags without large gaps
};

// Turns what the file says into a mesh. The file and the tokens must outlive it.
class MeshBuilder {
 public:
  MeshBuilder(GmshFile& file, const GmshTokens& tokens)
      : file_(file), tokens_(tokens), number_(sort_by_tag(file.nodes, tokens)) {}

  LoadedMesh build() {
    check_sections();
    for (const GmshNode& node : file_.nodes) loaded_.mesh.nodes.push_back(node.x);
    add_regions();
    add_tets();
    add_surfaces();
    warn_of_empty_groups();
    const Warnings found = validate(loaded_.mesh, origin());
    loaded_.warnings.insert(loaded_.warnings.end(), found.begin(), found.end());
    return std::move(loaded_);
  }

 private:
  static const std::vector<GmshNode>& sort_by_tag(std::vector<GmshNode>& nodes,
                                                  const GmshTokens& tokens) {
    const auto before = [](const GmshNode& a, const GmshNode& b) { return a.tag < b.tag; };
    if (!std::is_sorted(nodes.begin(), nodes.end(), before)) {
      std::stable_sort(nodes.begin(), nodes.end(), before);
    }
    const auto same =
        std::adjacent_find(nodes.begin(), nodes.end(),
                           [](const GmshNode& a, const GmshNode& b) { return a.tag == b.tag; });
    if (same != nodes.end()) {
      tokens.fail_at(
          (same + 1)->line,
          fmt::format("node tag {} is defined twice (first in line {})", same->tag, same->line));
    }
    return nodes;
  }

  void check_sections() const {
    for (const char* name : {"Nodes", "Elements"}) {
      if (!file_.section_lines.contains(name)) {
        tokens_.fail(fmt::format("the file ends without ${}; is it truncated?", name));
      }
    }
    if (file_.tets.empty()) {
      tokens_.fail_at(file_.section_lines.at("Elements"),
                      "no tetrahedra: did you mesh in 3D (gmsh -3)?");
    }
    if (file_.nodes.size() > static_cast<std::size_t>(std::numeric_limits<int>::max())) {
      tokens_.fail(fmt::format("{} nodes are too many", file_.nodes.size()));
    }
  }

  std::string group_name(int dim, int tag) const {
    const auto name = file_.names.find({dim, tag});
    if (name != file_.names.end() && !name->second.empty()) return name->second;
    return fmt::format("{}{}", dim == 3 ? "volume" : "surface", tag);
  }

  const std::vector<int>& groups_of(const auto& element) const {
    return file_.group_sets[static_cast<std::size_t>(element.groups)];
  }

  // The physical tag of a tet, 0 if it has none.
  int region_tag(const GmshElement<4>& tet) const {
    const std::vector<int>& groups = groups_of(tet);
    if (groups.empty()) return 0;
    for (int group : groups) {
      if (std::abs(group) == std::abs(groups[0])) continue;
      tokens_.fail_at(
          tet.line,
          fmt::format("element {}: in two physical volumes, \"{}\" and \"{}\"; an element "
                      "belongs to one region: put its volume in one physical group",
                      tet.tag, group_name(3, std::abs(groups[0])), group_name(3, std::abs(group))));
    }
    return std::abs(groups[0]);
  }

  // Groups of the same name are one region.
  void add_regions() {
    std::map<int, int> tets_with;
    for (const GmshElement<4>& tet : file_.tets) ++tets_with[region_tag(tet)];
    std::map<std::string, int> index;
    for (const auto& [tag, tets] : tets_with) {
      const std::string name = tag == 0 ? "body" : group_name(3, tag);
      const auto [entry, is_new] = index.emplace(name, static_cast<int>(index.size()));
      if (is_new) loaded_.mesh.region_names.push_back(name);
      region_index_[tag] = entry->second;
    }
    if (tets_with.contains(0) && tets_with.size() > 1) {
      loaded_.warnings.push_back(fmt::format(
          "{}: {} of {} tetrahedra are in no physical volume; they are in region \"body\"",
          tokens_.path(), tets_with[0], file_.tets.size()));
    }
  }

  template <std::size_t N>
  std::array<int, N> node_numbers(const GmshElement<N>& element) const {
    std::array<int, N> numbers{};
    for (std::size_t i = 0; i < N; ++i) {
      numbers[i] = number_(element.nodes[i]);
      if (numbers[i] < 0) {
        tokens_.fail_at(element.line, fmt::format("element {}: node {} is not defined in $Nodes",
                                                  element.tag, element.nodes[i]));
      }
    }
    return numbers;
  }

  void add_tets() {
    for (const GmshElement<4>& tet : file_.tets) {
      loaded_.mesh.tets.push_back(node_numbers(tet));
      loaded_.mesh.region_of.push_back(region_index_.at(region_tag(tet)));
    }
  }

  void add_surfaces() {
    for (std::size_t t = 0; t < file_.triangles.size(); ++t) {
      const Triangle nodes = node_numbers(file_.triangles[t]);
      const Triangle reversed = {nodes[0], nodes[2], nodes[1]};
      for (int tag : groups_of(file_.triangles[t])) {
        const std::string name = group_name(2, std::abs(tag));
        loaded_.mesh.surfaces[name].push_back(tag < 0 ? reversed : nodes);
        triangles_of_[name].push_back(t);
      }
    }
  }

  void warn_of_empty_groups() {
    const auto& regions = loaded_.mesh.region_names;
    for (const auto& [dim_tag, name] : file_.names) {
      const auto [dim, tag] = dim_tag;
      const std::string used = group_name(dim, tag);
      const bool empty = (dim == 2 && !loaded_.mesh.surfaces.contains(used)) ||
                         (dim == 3 && std::count(regions.begin(), regions.end(), used) == 0);
      if (!empty) continue;
      loaded_.warnings.push_back(fmt::format("{}: physical {} \"{}\" has no {}", tokens_.path(),
                                             dim == 3 ? "volume" : "surface", used,
                                             dim == 3 ? "tetrahedra" : "triangles"));
    }
  }

  std::string element_name(const auto& element) const {
    return fmt::format("{}:{}: element {}", tokens_.path(), element.line, element.tag);
  }

  MeshOrigin origin() const {
    return {
        .source = tokens_.path(),
        .tet_name = [this](int t) { return element_name(file_.tets[static_cast<std::size_t>(t)]); },
        .node_name =
            [this](int n) {
              const GmshNode& node = file_.nodes[static_cast<std::size_t>(n)];
              return fmt::format("{}:{}: node {}", tokens_.path(), node.line, node.tag);
            },
        .triangle_name =
            [this](const std::string& surface, int k) {
              return element_name(
                  file_.triangles[triangles_of_.at(surface)[static_cast<std::size_t>(k)]]);
            },
    };
  }

  const GmshFile& file_;
  const GmshTokens& tokens_;
  NodeNumbers number_;
  std::map<int, int> region_index_;  // by physical tag
  std::map<std::string, std::vector<std::size_t>> triangles_of_;
  LoadedMesh loaded_;
};

}  // namespace

LoadedMesh build_gmsh_mesh(GmshFile& file, const GmshTokens& tokens) {
  return MeshBuilder(file, tokens).build();
}

}  // namespace orthodyn
