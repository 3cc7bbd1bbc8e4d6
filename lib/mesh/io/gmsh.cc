#include "lib/mesh/io/gmsh.h"

#include <fmt/format.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cstdlib>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "lib/core/spelling.h"
#include "lib/mesh/io/gmsh_file.h"
#include "lib/mesh/io/text_tokens.h"

namespace orthodyn {
namespace {

constexpr const char* kKinds[] = {"points", "curve", "surface", "volume"};
constexpr const char* kParts[] = {"nodes", "lines of first or second order", "faces", "solid elements"};

// Builds the draft of a file; moves the nodes out of the file. `file` and `tokens` (for messages) must outlive the
// builder.
class MeshBuilder {
 public:
  MeshBuilder(GmshFile& file, const TextTokens& tokens) : file_(file), tokens_(tokens) {}

  MeshDraft build() {
    check_sections();
    draft_.files = {tokens_.path()};
    draft_.nodes_section = "$Nodes";
    draft_.nodes = std::move(file_.nodes);
    add_regions();
    add_cells();
    add_surfaces();
    add_node_sets();
    warn_of_empty_groups();
    return std::move(draft_);
  }

 private:
  void check_sections() const {
    for (const char* name : {"Nodes", "Elements"})
      if (!file_.section_lines.contains(name)) tokens_.fail("the file ends without ${}; is it truncated?", name);
    if (file_.cells.empty())
      tokens_.fail_at(file_.section_lines.at("Elements"), "no solid elements: {}", why_no_cells());
  }

  std::string why_no_cells() const {
    std::vector<std::string> groups;
    bool names_volume = false;
    for (const auto& [dim_tag, name] : file_.names) {
      if (dim_tag.first < 3) groups.push_back(fmt::format("\"{}\"", name));
      else names_volume = true;
    }
    for (const auto& [dim_tag, set] : file_.entity_groups)
      if (groups.empty() && set > 0) groups.push_back("of surfaces, curves or points");
    if (is_flat()) return "all nodes lie in one plane: a 2D mesh; extrude the surface, and mesh in 3D (gmsh -3)";
    const auto is_volume = [](const auto& entity) { return entity.first.first == 3; };
    const bool lists_entities = file_.section_lines.contains("Entities");
    const bool has_volume = std::any_of(file_.entity_groups.begin(), file_.entity_groups.end(), is_volume);
    if (!names_volume && !groups.empty() && (has_volume || !lists_entities))
      return fmt::format(
          "there are physical groups ({}) but no Physical Volume, and Gmsh saves only elements that are in a physical "
          "group; add one, for example Physical Volume(\"body\") = {{1}}; (or set Mesh.SaveAll = 1), and mesh in 3D "
          "(gmsh -3)",
          join(groups));
    return "did you mesh in 3D (gmsh -3)?";
  }

  // Whether all nodes lie in one plane and the file lists no volume.
  bool is_flat() const {
    for (const auto& [dim_tag, set] : file_.entity_groups)
      if (dim_tag.first == 3) return false;
    if (file_.nodes.empty()) return false;
    Eigen::Matrix3d spread = Eigen::Matrix3d::Zero();
    for (const FileNode& node : file_.nodes) {
      const Vec3 x = node.x - file_.nodes.front().x;
      spread += x * x.transpose();
    }
    const auto values = Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(spread).eigenvalues();
    return values[0] <= 1e-12 * values[2];
  }

  std::string group_name(int dim, int tag) const {
    auto name = file_.names.find({dim, tag});
    if (name == file_.names.end()) name = file_.names.find({kAnyDimension, tag});
    if (name != file_.names.end() && !name->second.empty()) return name->second;
    return fmt::format("{}{}", kKinds[dim], tag);
  }

  const std::vector<int>& groups_of(const auto& element) const {
    return file_.group_sets[static_cast<std::size_t>(element.groups)];
  }

  // The physical tag of a cell, 0 for none.
  int region_tag(const Grouped<FileCell>& cell) const {
    const std::vector<int>& groups = groups_of(cell);
    if (groups.empty()) return 0;
    for (int group : groups) {
      if (std::abs(group) == std::abs(groups[0])) continue;
      tokens_.fail_at(cell.element.place.line,
                      "element {}: in two physical volumes, \"{}\" and \"{}\"; an element belongs to one region: put "
                      "its volume in one physical group",
                      cell.element.tag, group_name(3, std::abs(groups[0])), group_name(3, std::abs(group)));
    }
    return std::abs(groups[0]);
  }

  // Groups with the same name form one region.
  void add_regions() {
    std::map<int, int> cells_with;
    for (const Grouped<FileCell>& cell : file_.cells) ++cells_with[region_tag(cell)];
    for (const auto& [tag, cells] : cells_with)
      region_index_[tag] = draft_.region_index(tag == 0 ? "body" : group_name(3, tag));
    if (cells_with.contains(0) && cells_with.size() > 1)
      draft_.warn({}, "{} of {} elements are in no physical volume; they are in region \"body\"", cells_with[0],
                  file_.cells.size());
  }

  void add_cells() {
    draft_.cells.reserve(file_.cells.size());
    for (const Grouped<FileCell>& cell : file_.cells) {
      draft_.cells.push_back(cell.element);
      draft_.cells.back().region = region_index_.at(region_tag(cell));
    }
  }

  // A negative tag means that the group has the opposite orientation.
  void add_surfaces() {
    for (const Grouped<FileFace>& face : file_.faces) {
      for (int tag : groups_of(face)) {
        FileFace turned = face.element;
        if (tag < 0) std::reverse(turned.corners().begin() + 1, turned.corners().end());
        draft_.surfaces[group_name(2, std::abs(tag))].push_back(turned);
      }
    }
  }

  // Physical points and curves; groups with the same name form one set.
  void add_node_sets() {
    const auto add = [&](const std::vector<Grouped<FileNodeUse>>& uses, int dim) {
      for (const Grouped<FileNodeUse>& node : uses)
        for (const int tag : groups_of(node)) draft_.node_sets[group_name(dim, std::abs(tag))].push_back(node.element);
    };
    add(file_.points, 0);
    add(file_.curves, 1);
  }

  void warn_of_empty_groups() {
    const auto& regions = draft_.region_names;
    for (const auto& [dim_tag, name] : file_.names) {
      const auto [dim, tag] = dim_tag;
      if (dim == kAnyDimension) continue;
      const std::string used = group_name(dim, tag);
      const bool empty = (dim < 2 && !draft_.node_sets.contains(used)) ||
                         (dim == 2 && !draft_.surfaces.contains(used)) ||
                         (dim == 3 && std::count(regions.begin(), regions.end(), used) == 0);
      if (!empty) continue;
      draft_.warn({}, "physical {} \"{}\" has no {}", kKinds[dim], used, kParts[dim]);
    }
  }

  GmshFile& file_;
  const TextTokens& tokens_;
  std::map<int, int> region_index_;  // by physical tag
  MeshDraft draft_;
};

const bool gmsh_registered[] = {
    register_mesh_format({.name = "Gmsh", .endings = {".msh"}, .read = read_gmsh, .write = write_gmsh41}),
    register_mesh_format({.name = "Gmsh 2.2", .endings = {".msh2"}, .read = read_gmsh, .write = write_gmsh22})};

}  // namespace

LoadedMesh read_gmsh(const std::string& path, FileCells cells) {
  return read_gmsh_text(path, read_text_file(path), cells);
}

LoadedMesh read_gmsh_text(const std::string& path, std::string_view text, FileCells cells) {
  if (is_binary_gmsh(text)) return read_gmsh_text(path, ascii_of_binary_gmsh(path, text), cells);
  TextTokens tokens(path, text);
  GmshFile file = read_gmsh_sections(tokens);
  return build_mesh(MeshBuilder(file, tokens).build(), cells);
}

}  // namespace orthodyn
