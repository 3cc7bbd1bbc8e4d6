#include "lib/mesh/io/abaqus.h"

#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <map>
#include <set>
#include <utility>

#include "lib/core/spelling.h"
#include "lib/mesh/io/abaqus_axes.h"
#include "lib/mesh/io/abaqus_file.h"
#include "lib/mesh/io/text_tokens.h"
#include "lib/mesh/split_cells.h"

namespace orthodyn {
namespace {

// Numbers of nodes or elements, ascending, each with its index.
using Numbers = std::vector<std::pair<std::int64_t, std::size_t>>;

Numbers numbers_of(const auto& things) {
  Numbers numbers;
  for (std::size_t i = 0; i < things.size(); ++i) numbers.emplace_back(things[i].tag, i);
  std::sort(numbers.begin(), numbers.end());
  return numbers;
}

class AbaqusMesh {
 public:
  explicit AbaqusMesh(AbaqusFile file) : file_(std::move(file)), draft_(file_.draft) {
    nodes_ = numbers_of(draft_.nodes);
    cells_ = numbers_of(draft_.cells);
    faces_ = numbers_of(file_.faces);
    left_out_ = numbers_of(file_.left_out);
    budget_ = 1000 + 100 * (nodes_.size() + cells_.size() + faces_.size());
  }

  LoadedMesh build() {
    make_draft();
    const std::vector<Mat3> axes = axes_of_cells();
    std::map<std::string, MeshMaterial> materials = materials_of_regions();
    LoadedMesh loaded = build_mesh(std::move(draft_));
    loaded.materials = std::move(materials);
    if (!axes.empty()) add_axes(axes, loaded);
    return loaded;
  }

 private:
  void make_draft() {
    if (draft_.cells.empty())
      draft_.fail({},
                  fmt::format("no solid elements (C3D4, C3D8, C3D6, ...){}",
                              faces_.empty() ? ""
                                             : fmt::format(": {} elements of planes or shells alone are a 2D mesh or "
                                                           "a surface; mesh its inside",
                                                           faces_.size())));
    check_elements_differ();
    add_regions();
    add_surfaces();
    for (const auto& [key, set] : file_.node_sets) {
      auto& uses = draft_.node_sets[set.name];
      for (const AbaqusMembers& m : set.members)
        if (set.of_condition) each(m, nodes_, [&](std::size_t n) { uses.push_back({draft_.nodes[n].tag, m.place}); });
        else append_node_uses(m, uses);
    }
    warn_of_undefined_elements();
  }

  // Those of each cell by the orientation of its section, or those of space; none if no section has one.
  std::vector<Mat3> axes_of_cells() {
    std::vector<Mat3> axes;
    std::map<std::string, AbaqusAxes> known;
    for (std::size_t c = 0; c < draft_.cells.size(); ++c) {
      if (section_of_[c] < 0) continue;
      const AbaqusSection& section = file_.sections[static_cast<std::size_t>(section_of_[c])];
      if (section.orientation.empty()) continue;
      if (axes.empty()) axes.assign(draft_.cells.size(), Mat3::Identity());
      auto found = known.find(section.orientation);
      if (found == known.end()) found = known.emplace(section.orientation, axes_by(section)).first;
      axes[c] = found->second.of(c, centre_of(draft_.cells[c]));
    }
    return axes;
  }

  AbaqusAxes axes_by(const AbaqusSection& section) {
    const AbaqusOrientation* orientation = find_abaqus(file_.orientations, section.orientation);
    if (!orientation)
      draft_.fail(section.elements.place,
                  fmt::format("*SOLID SECTION: no *ORIENTATION {}", TextTokens::quoted(section.orientation)));
    return AbaqusAxes(
        file_, *orientation,
        [&](const AbaqusMembers& members, const std::function<void(std::size_t)>& use) {
          each_element(members, cells_, use);
        },
        [&](std::int64_t node) { return position(node, orientation->place); });
  }

  const Vec3& position(std::int64_t tag, FilePlace place) const {
    const auto found = std::lower_bound(nodes_.begin(), nodes_.end(), std::pair(tag, std::size_t{0}));
    if (found == nodes_.end() || found->first != tag)
      draft_.fail(place, fmt::format("node {} is not defined in *NODE", tag % kAbaqusAssembly));
    return draft_.nodes[found->second].x;
  }

  Vec3 centre_of(const FileCell& cell) const {
    Vec3 sum = Vec3::Zero();
    for (const std::int64_t node : cell.corners()) sum += position(node, cell.place);
    return sum / static_cast<double>(cell.corners().size());
  }

  // Axes 1 and 2 of each tet as cell data.
  static void add_axes(const std::vector<Mat3>& axes, LoadedMesh& loaded) {
    const TetMesh& mesh = loaded.mesh;
    CellData first{.name = "axis_1", .components = 3}, second{.name = "axis_2", .components = 3};
    for (std::size_t t = 0; t < mesh.tets.size(); ++t) {
      const Mat3& Q = axes[mesh.cell_of.empty() ? t : static_cast<std::size_t>(mesh.cell_of[t])];
      first.values.insert(first.values.end(), Q.col(0).begin(), Q.col(0).end());
      second.values.insert(second.values.end(), Q.col(1).begin(), Q.col(1).end());
    }
    loaded.cell_data = {std::move(first), std::move(second)};
  }

  std::map<std::string, MeshMaterial> materials_of_regions() const {
    std::map<std::string, MeshMaterial> materials;
    for (const auto& [name, section] : section_of_region_)
      if (!section->material.empty()) materials.emplace(name, material_of(*section));
    return materials;
  }

  MeshMaterial material_of(const AbaqusSection& section) const {
    const auto found = file_.materials.find(section.material);
    MeshMaterial material = found == file_.materials.end()
                                ? MeshMaterial{.name = section.material,
                                               .where = file_.draft.where(section.elements.place),
                                               .problem = "the file has no such *MATERIAL"}
                                : mesh_material(found->second, file_.draft);
    if (!section.orientation.empty()) material.axes_file = file_.draft.files.front();
    return material;
  }

  void check_elements_differ() const {
    const auto same = std::adjacent_find(cells_.begin(), cells_.end(),
                                         [](const auto& a, const auto& b) { return a.first == b.first; });
    if (same == cells_.end()) return;
    draft_.fail(draft_.cells[(same + 1)->second].place,
                fmt::format("element {} is defined twice (first in line {})", same->first,
                            draft_.cells[same->second].place.line));
  }

  // A range of many numbers costs no more than what exists of it.
  template <class Use>
  std::size_t each(const AbaqusMembers& m, const Numbers& numbers, Use&& use) {
    std::size_t found = 0;
    const auto from = [&](Numbers::const_iterator begin, std::int64_t number) {
      return std::lower_bound(begin, numbers.end(), std::pair(number, std::size_t{0}));
    };
    for (auto it = from(numbers.begin(), m.first); it != numbers.end() && it->first <= m.last;) {
      spend(m.place);
      const std::int64_t behind = (it->first - m.first) % m.step;  // neither is negative, see read_range()
      if (behind == 0) {
        use(it->second);
        ++found;
        ++it;
      } else if (const std::int64_t ahead = m.step - behind; ahead <= m.last - it->first) {
        it = from(it, it->first + ahead);
      } else {
        break;
      }
    }
    return found;
  }

  void spend(FilePlace place) {
    if (budget_-- == 0)
      draft_.fail(place, "the sets list every node and element more than 100 times; remove sets that are not needed");
  }

  const AbaqusSet& find(const AbaqusSets& sets, const AbaqusMembers& m, const char* keyword) const {
    const AbaqusSet* found = find_abaqus(sets, m.set);
    if (!found) draft_.fail(m.place, fmt::format("no *{} {}", keyword, TextTokens::quoted(m.set)));
    return *found;
  }

  // Sets may name sets, but not themselves (abaqus_sets.h).
  template <class Use>
  std::size_t each_element(const AbaqusMembers& m, const Numbers& numbers, Use&& use) {
    if (m.set.empty()) return each(m, numbers, use);
    std::size_t found = 0;
    for (const AbaqusMembers& inner : find(file_.element_sets, m, "ELSET").members) {
      spend(m.place);
      found += each_element(inner, numbers, use);
    }
    return found;
  }

  void append_node_uses(const AbaqusMembers& m, std::vector<FileNodeUse>& uses) {
    if (m.of_elements) return append_nodes_of_elements(m, uses);
    if (m.set.empty()) {
      const std::size_t found = each(m, nodes_, [&](std::size_t n) { uses.push_back({draft_.nodes[n].tag, m.place}); });
      if (found == 0 || (m.listed && found < count_of(m))) fail_node(m);
      return;
    }
    for (const AbaqusMembers& inner : find(file_.node_sets, m, "NSET").members) {
      spend(m.place);
      append_node_uses(inner, uses);
    }
  }

  static std::size_t count_of(const AbaqusMembers& m) { return static_cast<std::size_t>(m.last - m.first) + 1; }

  // Precondition: not all of these numbers exist.
  [[noreturn]] void fail_node(const AbaqusMembers& m) const {
    std::int64_t missing = m.first;
    for (auto it = std::lower_bound(nodes_.begin(), nodes_.end(), std::pair(m.first, std::size_t{0}));
         it != nodes_.end() && it->first == missing; ++it)
      ++missing;
    if (missing >= kAbaqusAssembly)
      draft_.fail(m.place, fmt::format("*NSET: node {} is not defined in the assembly; for one of an instance give "
                                       "INSTANCE=name",
                                       missing - kAbaqusAssembly));
    draft_.fail(m.place, fmt::format("*NSET: node {} is not defined in *NODE", missing));
  }

  void append_nodes_of_elements(const AbaqusMembers& m, std::vector<FileNodeUse>& uses) {
    const auto use = [&](std::int64_t node) {
      spend(m.place);
      uses.push_back({node, m.place});
    };
    const AbaqusMembers elements{.set = m.set, .place = m.place};
    each_element(elements, cells_, [&](std::size_t c) {
      const FileCell& cell = draft_.cells[c];
      for (const std::int64_t node : cell.corners()) use(node);
      if (cell.midsides) std::for_each(cell.midsides->begin(), cell.midsides->end(), use);
      for (const FileEdge& edge : cell.edges) use(edge.middle);
    });
    each_element(elements, faces_, [&](std::size_t f) {
      for (const std::int64_t node : file_.faces[f].corners()) use(node);
      std::for_each(file_.face_middles[f].begin(), file_.face_middles[f].end(), use);
    });
  }

  // Elements that a set lists and that no *ELEMENT defines.
  void warn_of_undefined_elements() {
    const auto within = [](const AbaqusMembers& m, const Numbers& numbers) {
      const auto before = [](const auto& entry, std::int64_t number) { return entry.first < number; };
      const auto begin = std::lower_bound(numbers.begin(), numbers.end(), m.first, before);
      return static_cast<std::size_t>(std::lower_bound(begin, numbers.end(), m.last + 1, before) - begin);
    };
    for (const auto& [key, set] : file_.element_sets) {
      std::size_t missing = 0;
      for (const AbaqusMembers& m : set.members)
        if (m.listed && m.set.empty())
          missing += count_of(m) - std::min(count_of(m), within(m, cells_) + within(m, faces_) + within(m, left_out_));
      if (missing > 0)
        draft_.warnings.push_back(fmt::format("{}: element set \"{}\" lists {} that no *ELEMENT defines",
                                              draft_.files.front(), set.name,
                                              counted(static_cast<long>(missing), "element")));
    }
  }

  struct Candidate {
    std::string name;
    AbaqusMembers members;
  };

  std::vector<Candidate> region_candidates() const {
    std::vector<Candidate> candidates;
    for (const AbaqusSection& section : file_.sections) {
      candidates.push_back({find(file_.element_sets, section.elements, "ELSET").name, section.elements});
    }
    if (!candidates.empty()) return candidates;
    std::vector<const AbaqusSets::value_type*> sets;
    for (const auto& entry : file_.element_sets) sets.push_back(&entry);
    std::sort(sets.begin(), sets.end(), [](auto a, auto b) { return a->second.order < b->second.order; });
    for (const auto* entry : sets) candidates.push_back({entry->second.name, {.set = entry->first}});
    return candidates;
  }

  void add_regions() {
    const std::vector<Candidate> candidates = region_candidates();
    std::vector<int> last(draft_.cells.size(), -1);
    std::vector<std::size_t> sizes(candidates.size());
    for (std::size_t c = 0; c < candidates.size(); ++c) take_elements(candidates, c, last, sizes);
    section_of_ = file_.sections.empty() ? std::vector<int>(last.size(), -1) : last;
    warn_of_other_sets();
    std::vector<int> region(candidates.size() + 1, -1);  // of each candidate; the last is the rest
    for (const int c : last) region[c < 0 ? candidates.size() : static_cast<std::size_t>(c)] = 0;
    int count = 0;
    for (std::size_t c = 0; c < region.size(); ++c) {
      if (region[c] < 0) continue;
      region[c] = count++;
      draft_.region_names.push_back(c < candidates.size() ? candidates[c].name : count == 1 ? "body" : "unassigned");
      if (c < file_.sections.size()) section_of_region_[draft_.region_names.back()] = &file_.sections[c];
    }
    for (std::size_t t = 0; t < last.size(); ++t) {
      draft_.cells[t].region = region[last[t] < 0 ? candidates.size() : static_cast<std::size_t>(last[t])];
    }
  }

  // Gives a candidate its elements; earlier ones lose theirs to it, which is said unless both are the same elements
  // by two names, as Gmsh writes them. `sizes`: elements of each.
  void take_elements(const std::vector<Candidate>& candidates, std::size_t c, std::vector<int>& last,
                     std::vector<std::size_t>& sizes) {
    std::map<std::size_t, std::size_t> taken;  // by earlier candidate
    each_element(candidates[c].members, cells_, [&](std::size_t t) {
      if (last[t] == static_cast<int>(c)) return;
      if (last[t] >= 0) ++taken[static_cast<std::size_t>(last[t])];
      last[t] = static_cast<int>(c);
      ++sizes[c];
    });
    for (const auto& [earlier, count] : taken) {
      const std::string& name = candidates[earlier].name;
      if (in_capitals(name) == in_capitals(candidates[c].name) || (count == sizes[earlier] && count == sizes[c]))
        continue;
      draft_.warnings.push_back(
          fmt::format("{}: {} elements of element set \"{}\" are in \"{}\", too, which comes "
                      "later: that is their region",
                      draft_.files.front(), count, name, candidates[c].name));
    }
  }

  // Where sections make regions, other sets do not, but those that surfaces are made of, and internal ones ("_Top_S1").
  void warn_of_other_sets() {
    if (file_.sections.empty()) return;
    std::set<std::string> used;
    for (const AbaqusSection& section : file_.sections) used.insert(section.elements.set);
    for (const auto& [key, surface] : file_.surfaces)
      for (const AbaqusFace& face : surface.faces) used.insert(face.elements.set);
    std::vector<std::string> others;
    for (const auto& [key, set] : file_.element_sets) {
      if (used.contains(key) || set.name.starts_with("_")) continue;
      const std::size_t count = each_element({.set = key}, cells_, [](std::size_t) {});
      if (count > 0) others.push_back(fmt::format("{} ({} elements)", set.name, count));
    }
    if (!others.empty())
      draft_.warnings.push_back(fmt::format("{}: element sets without a *SOLID SECTION are no regions: {}",
                                            draft_.files.front(), join(others)));
  }

  FileFace face_of(const FileCell& cell, const AbaqusFace& face, const std::string& surface) const {
    const std::vector<Places>& faces = faces_of(cell.kind);
    if (face.side >= faces.size())
      draft_.fail(face.elements.place,
                  fmt::format("surface {}: S{} of element {}; a {} has S1 to S{}", TextTokens::quoted(surface),
                              face.side + 1, cell.tag, name_of(cell.kind), faces.size()));
    const Places& places = faces[face.side];
    FileFace out{.tag = cell.tag, .sides = places.size(), .place = face.elements.place};
    for (std::size_t k = 0; k < places.size(); ++k) out.nodes[k] = cell.nodes[places[k]];
    return out;
  }

  // SPOS or SNEG: the shell itself, seen from the side of its normal or from the other.
  void add_sides_of_shells(const AbaqusFace& side, const std::string& surface, std::vector<FileFace>& faces) {
    const std::size_t found = each_element(side.elements, faces_, [&](std::size_t f) {
      faces.push_back(file_.faces[f]);
      if (side.side == AbaqusFace::kNegative) {
        const auto corners = faces.back().corners();
        std::reverse(corners.begin() + 1, corners.end());
      }
    });
    if (found == 0)
      draft_.fail(side.elements.place,
                  fmt::format("surface {}: SPOS and SNEG are sides of shells and membranes, and there is no such "
                              "element; solid elements have S1 to S6",
                              TextTokens::quoted(surface)));
  }

  // What a *DLOAD lists: there may be elements of other kinds, whose loads have the same names.
  void add_loaded_faces(const AbaqusSurface& surface) {
    std::vector<FileFace> faces;
    for (const AbaqusFace& face : surface.faces) {
      if (!face.elements.set.empty() && !find_abaqus(file_.element_sets, face.elements.set)) continue;
      each_element(face.elements, cells_, [&](std::size_t c) {
        if (face.side < faces_of(draft_.cells[c].kind).size())
          faces.push_back(face_of(draft_.cells[c], face, surface.name));
      });
    }
    if (!faces.empty()) draft_.surfaces[surface.name] = std::move(faces);
  }

  void add_surfaces() {
    for (const auto& [key, surface] : file_.surfaces) {
      if (surface.of_condition) {
        add_loaded_faces(surface);
        continue;
      }
      auto& faces = draft_.surfaces[surface.name];
      for (const AbaqusFace& face : surface.faces) {
        if (face.side >= AbaqusFace::kPositive) {
          add_sides_of_shells(face, surface.name, faces);
          continue;
        }
        const std::size_t found = each_element(face.elements, cells_, [&, &name = surface.name](std::size_t c) {
          faces.push_back(face_of(draft_.cells[c], face, name));
        });
        if (found == 0)
          draft_.fail(face.elements.place,
                      fmt::format("surface {}: no such solid element", TextTokens::quoted(surface.name)));
      }
    }
    if (file_.faces.empty()) return;
    for (const auto& [key, set] : file_.element_sets) {
      std::vector<FileFace> found;
      each_element({.set = key}, faces_, [&](std::size_t t) { found.push_back(file_.faces[t]); });
      if (!found.empty() && !draft_.surfaces.contains(set.name)) draft_.surfaces[set.name] = std::move(found);
    }
  }

  AbaqusFile file_;
  MeshDraft& draft_;
  Numbers nodes_, cells_, faces_, left_out_;
  std::size_t budget_ = 0;
  std::vector<int> section_of_;  // of each cell, an index into file_.sections; -1 for none
  std::map<std::string, const AbaqusSection*> section_of_region_;
};

const bool abaqus_registered = register_mesh_format(
    {.name = "Abaqus", .endings = {".inp"}, .read = read_abaqus, .write = write_abaqus, .brings_materials = true});

}  // namespace

LoadedMesh read_abaqus(const std::string& path) { return read_abaqus_text(path, read_text_file(path)); }

LoadedMesh read_abaqus_text(const std::string& path, std::string_view text) {
  return AbaqusMesh(read_abaqus_keywords(path, text)).build();
}

}  // namespace orthodyn
