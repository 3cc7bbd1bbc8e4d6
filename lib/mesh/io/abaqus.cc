#include "lib/mesh/io/abaqus.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

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
    budget_ = 1000 + 100 * (nodes_.size() + cells_.size() + faces_.size());
  }

  MeshDraft build() {
    if (draft_.cells.empty()) draft_.fail({}, "no solid elements (C3D4, C3D8, C3D6, ...)");
    check_elements_differ();
    add_regions();
    add_surfaces();
    for (const auto& [key, set] : file_.node_sets) {
      auto& uses = draft_.node_sets[set.name];
      for (const AbaqusMembers& m : set.members) append_node_uses(m, uses);
    }
    return std::move(draft_);
  }

 private:
  void check_elements_differ() const {
    const auto same = std::adjacent_find(cells_.begin(), cells_.end(),
                                         [](const auto& a, const auto& b) { return a.first == b.first; });
    if (same == cells_.end()) return;
    draft_.fail(draft_.cells[(same + 1)->second].place, fmt::format("element {} is defined twice (first in line {})",
                                                                   same->first, draft_.cells[same->second].place.line));
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
    const auto found = sets.find(m.set);
    if (found == sets.end()) draft_.fail(m.place, fmt::format("no *{} {}", keyword, TextTokens::quoted(m.set)));
    return found->second;
  }

  // Sets may name sets; `depth` bounds circles.
  template <class Use>
  std::size_t each_element(const AbaqusMembers& m, const Numbers& numbers, Use&& use, int depth = 0) {
    if (m.set.empty()) return each(m, numbers, use);
    if (depth > 20) draft_.fail(m.place, fmt::format("set {} contains itself", TextTokens::quoted(m.set)));
    std::size_t found = 0;
    for (const AbaqusMembers& inner : find(file_.element_sets, m, "ELSET").members) {
      spend(m.place);
      found += each_element(inner, numbers, use, depth + 1);
    }
    return found;
  }

  void append_node_uses(const AbaqusMembers& m, std::vector<FileNodeUse>& uses, int depth = 0) {
    if (m.set.empty()) {
      const std::size_t found = each(m, nodes_, [&](std::size_t n) { uses.push_back({draft_.nodes[n].tag, m.place}); });
      if (found == 0) draft_.fail(m.place, fmt::format("*NSET: node {} is not defined in *NODE", m.first));
      return;
    }
    if (depth > 20) draft_.fail(m.place, fmt::format("set {} contains itself", TextTokens::quoted(m.set)));
    for (const AbaqusMembers& inner : find(file_.node_sets, m, "NSET").members) {
      spend(m.place);
      append_node_uses(inner, uses, depth + 1);
    }
  }

  struct Candidate {
    std::string name;
    AbaqusMembers members;
  };

  std::vector<Candidate> region_candidates() const {
    std::vector<Candidate> candidates;
    for (const AbaqusMembers& section : file_.sections) {
      candidates.push_back({find(file_.element_sets, section, "ELSET").name, section});
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
    for (std::size_t c = 0; c < candidates.size(); ++c) {
      each_element(candidates[c].members, cells_, [&](std::size_t t) { last[t] = static_cast<int>(c); });
    }
    std::vector<int> region(candidates.size() + 1, -1);  // of each candidate; the last is the rest
    for (const int c : last) region[c < 0 ? candidates.size() : static_cast<std::size_t>(c)] = 0;
    int count = 0;
    for (std::size_t c = 0; c < region.size(); ++c) {
      if (region[c] < 0) continue;
      region[c] = count++;
      draft_.region_names.push_back(c < candidates.size() ? candidates[c].name : count == 1 ? "body" : "unassigned");
    }
    for (std::size_t t = 0; t < last.size(); ++t) {
      draft_.cells[t].region = region[last[t] < 0 ? candidates.size() : static_cast<std::size_t>(last[t])];
    }
  }

  FileFace face_of(const FileCell& cell, const AbaqusFace& face, const std::string& surface) const {
    const std::vector<Places>& faces = faces_of(cell.kind);
    if (face.side >= faces.size())
      draft_.fail(face.elements.place, fmt::format("surface {}: S{} of element {}; a {} has S1 to S{}",
                                                   TextTokens::quoted(surface), face.side + 1, cell.tag,
                                                   name_of(cell.kind), faces.size()));
    const Places& places = faces[face.side];
    FileFace out{.tag = cell.tag, .sides = places.size(), .place = face.elements.place};
    for (std::size_t k = 0; k < places.size(); ++k) out.nodes[k] = cell.nodes[places[k]];
    return out;
  }

  void add_surfaces() {
    for (const auto& [key, surface] : file_.surfaces) {
      auto& faces = draft_.surfaces[surface.name];
      for (const AbaqusFace& face : surface.faces) {
        const std::size_t found = each_element(face.elements, cells_, [&, &name = surface.name](std::size_t c) {
          faces.push_back(face_of(draft_.cells[c], face, name));
        });
        if (found == 0)
          draft_.fail(face.elements.place, fmt::format("surface {}: no such solid element",
                                                       TextTokens::quoted(surface.name)));
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
  Numbers nodes_, cells_, faces_;
  std::size_t budget_ = 0;
};

const bool abaqus_registered = register_mesh_format(
    {.name = "Abaqus", .endings = {".inp"}, .read = read_abaqus, .write = write_abaqus});

}  // namespace

LoadedMesh read_abaqus(const std::string& path) { return read_abaqus_text(path, read_text_file(path)); }

LoadedMesh read_abaqus_text(const std::string& path, std::string_view text) {
  return build_mesh(AbaqusMesh(read_abaqus_keywords(path, text)).build());
}

}  // namespace orthodyn
