#include "lib/mesh/io/abaqus_regions.h"

#include <algorithm>
#include <set>

#include "lib/core/spelling.h"
#include "lib/mesh/io/text_tokens.h"

namespace orthodyn {
namespace {

struct RegionCandidate {
  std::string name;
  AbaqusMembers members;
};

std::vector<RegionCandidate> region_candidates(const AbaqusFile& file, const AbaqusLookup& lookup) {
  std::vector<RegionCandidate> candidates;
  for (const AbaqusSection& section : file.sections)
    candidates.push_back({lookup.element_set(section.elements).name, section.elements});
  if (!candidates.empty()) return candidates;
  std::vector<const AbaqusSets::value_type*> sets;
  for (const auto& entry : file.element_sets) sets.push_back(&entry);
  std::sort(sets.begin(), sets.end(), [](auto a, auto b) { return a->second.order < b->second.order; });
  for (const auto* entry : sets) candidates.push_back({entry->second.name, {.set = entry->first}});
  return candidates;
}

// The last candidate that contains each cell, -1 for none. No warning if two candidates are the same elements under two
// names, as Gmsh writes them.
std::vector<int> last_candidates(AbaqusFile& file, AbaqusLookup& lookup,
                                 const std::vector<RegionCandidate>& candidates) {
  std::vector<int> last(file.draft.cells.size(), -1);
  std::vector<std::size_t> sizes(candidates.size());
  for (std::size_t c = 0; c < candidates.size(); ++c) {
    std::map<std::size_t, std::size_t> taken;  // number of elements, by earlier candidate
    lookup.each_cell(candidates[c].members, [&](std::size_t t) {
      if (last[t] == static_cast<int>(c)) return;
      if (last[t] >= 0) ++taken[static_cast<std::size_t>(last[t])];
      last[t] = static_cast<int>(c);
      ++sizes[c];
    });
    for (const auto& [earlier, count] : taken) {
      const std::string& name = candidates[earlier].name;
      if (in_capitals(name) == in_capitals(candidates[c].name) || (count == sizes[earlier] && count == sizes[c]))
        continue;
      file.draft.warn({},
                      "{} elements of element set \"{}\" are also in \"{}\", which comes later: that is their region",
                      count, name, candidates[c].name);
    }
  }
  return last;
}

// Warns of element sets that become no region, except those that surfaces use and internal ones ("_Top_S1").
void warn_of_other_sets(AbaqusFile& file, AbaqusLookup& lookup) {
  if (file.sections.empty()) return;
  std::set<std::string> used;
  for (const AbaqusSection& section : file.sections) used.insert(section.elements.set);
  for (const auto& [key, surface] : file.surfaces)
    for (const AbaqusFace& face : surface.faces) used.insert(face.elements.set);
  std::vector<std::string> others;
  for (const auto& [key, set] : file.element_sets) {
    if (used.contains(key) || set.name.starts_with("_")) continue;
    const std::size_t count = lookup.each_cell({.set = key}, [](std::size_t) {});
    if (count > 0) others.push_back(fmt::format("{} ({} elements)", set.name, count));
  }
  if (!others.empty())
    file.draft.warn({}, "element sets without a *SOLID SECTION do not become regions: {}", join(others));
}

}  // namespace

AbaqusRegions add_abaqus_regions(AbaqusFile& file, AbaqusLookup& lookup) {
  const std::vector<RegionCandidate> candidates = region_candidates(file, lookup);
  const std::vector<int> last = last_candidates(file, lookup, candidates);
  warn_of_other_sets(file, lookup);
  AbaqusRegions out{std::vector<const AbaqusSection*>(last.size(), nullptr), {}};
  const std::size_t rest = candidates.size();
  const auto candidate_of = [&](int c) { return c < 0 ? rest : static_cast<std::size_t>(c); };
  std::vector<int> region(rest + 1, -1);  // region of each candidate, then of the remaining elements
  for (const int c : last) region[candidate_of(c)] = 0;
  int count = 0;
  for (std::size_t c = 0; c < region.size(); ++c) {
    if (region[c] < 0) continue;
    region[c] = count++;
    file.draft.region_names.push_back(c < rest ? candidates[c].name : count == 1 ? "body" : "unassigned");
    if (c < file.sections.size()) out.section_of_region[file.draft.region_names.back()] = &file.sections[c];
  }
  for (std::size_t t = 0; t < last.size(); ++t) {
    const std::size_t c = candidate_of(last[t]);
    file.draft.cells[t].region = region[c];
    if (c < file.sections.size()) out.section_of_cell[t] = &file.sections[c];
  }
  return out;
}

}  // namespace orthodyn
