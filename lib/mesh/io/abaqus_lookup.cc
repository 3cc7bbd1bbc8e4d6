#include "lib/mesh/io/abaqus_lookup.h"

#include <algorithm>

#include "lib/mesh/io/text_tokens.h"

namespace orthodyn {
namespace {

// The number of integers from first to last.
std::size_t count_of(const AbaqusMembers& m) { return static_cast<std::size_t>(m.last - m.first) + 1; }

auto lower_bound(const auto& numbers, std::int64_t number) {
  return std::lower_bound(numbers.begin(), numbers.end(), std::pair(number, std::size_t{0}));
}

}  // namespace

AbaqusLookup::Numbers AbaqusLookup::numbers_of(const auto& things) {
  Numbers numbers;
  for (std::size_t i = 0; i < things.size(); ++i) numbers.emplace_back(things[i].tag, i);
  std::sort(numbers.begin(), numbers.end());
  return numbers;
}

AbaqusLookup::AbaqusLookup(const AbaqusFile& file)
    : file_(file),
      nodes_(numbers_of(file.draft.nodes)),
      cells_(numbers_of(file.draft.cells)),
      faces_(numbers_of(file.faces)),
      ignored_(numbers_of(file.ignored_elements)),
      visits_left_(1000 + 100 * (nodes_.size() + cells_.size() + faces_.size())) {
  check_elements_differ();
}

void AbaqusLookup::check_elements_differ() const {
  const auto same =
      std::adjacent_find(cells_.begin(), cells_.end(), [](const auto& a, const auto& b) { return a.first == b.first; });
  if (same == cells_.end()) return;
  const auto& cells = file_.draft.cells;
  file_.draft.fail(cells[(same + 1)->second].place, "element {} is defined twice (first in line {})", same->first,
                   cells[same->second].place.line);
}

void AbaqusLookup::count_visit(FilePlace place) {
  if (visits_left_-- == 0)
    file_.draft.fail(place,
                     "the sets list every node and element more than 100 times; remove sets that are not needed");
}

// The cost is proportional to the existing numbers in the range, however long the range is.
std::size_t AbaqusLookup::each(const AbaqusMembers& m, const Numbers& numbers, const Use& use) {
  std::size_t found = 0;
  for (auto it = lower_bound(numbers, m.first); it != numbers.end() && it->first <= m.last;) {
    count_visit(m.place);
    const std::int64_t behind = (it->first - m.first) % m.step;  // neither is negative, see read_range()
    if (behind == 0) {
      use(it->second);
      ++found;
      ++it;
    } else if (const std::int64_t ahead = m.step - behind; ahead <= m.last - it->first) {
      it = std::lower_bound(it, numbers.end(), std::pair(it->first + ahead, std::size_t{0}));
    } else {
      break;
    }
  }
  return found;
}

const AbaqusSet& AbaqusLookup::find(const AbaqusSets& sets, const AbaqusMembers& m, const char* keyword) const {
  const AbaqusSet* found = find_abaqus(sets, m.set);
  if (!found) file_.draft.fail(m.place, "no *{} {}", keyword, TextTokens::quoted(m.set));
  return *found;
}

const AbaqusSet& AbaqusLookup::element_set(const AbaqusMembers& m) const {
  return find(file_.element_sets, m, "ELSET");
}

// The recursion ends: check_set_nesting() has refused sets that contain themselves.
std::size_t AbaqusLookup::each_element(const AbaqusMembers& m, const Numbers& numbers, const Use& use) {
  if (m.set.empty()) return each(m, numbers, use);
  std::size_t found = 0;
  for (const AbaqusMembers& inner : element_set(m).members) {
    count_visit(m.place);
    found += each_element(inner, numbers, use);
  }
  return found;
}

std::vector<FileNodeUse> AbaqusLookup::nodes_of(const AbaqusSet& set) {
  std::vector<FileNodeUse> uses;
  for (const AbaqusMembers& m : set.members)
    if (set.of_condition) each(m, nodes_, [&](std::size_t n) { uses.push_back({file_.draft.nodes[n].tag, m.place}); });
    else append_nodes(m, uses);
  return uses;
}

void AbaqusLookup::append_nodes(const AbaqusMembers& m, std::vector<FileNodeUse>& uses) {
  if (m.of_elements) return append_nodes_of_elements(m, uses);
  if (m.set.empty()) {
    const std::size_t found = each(m, nodes_, [&](std::size_t n) {
      uses.push_back({file_.draft.nodes[n].tag, m.place});
    });
    if (found == 0 || (m.listed && found < count_of(m))) fail_missing_node(m);
    return;
  }
  for (const AbaqusMembers& inner : find(file_.node_sets, m, "NSET").members) {
    count_visit(m.place);
    append_nodes(inner, uses);
  }
}

// Precondition: not all of the members exist.
void AbaqusLookup::fail_missing_node(const AbaqusMembers& m) const {
  std::int64_t missing = m.first;
  for (auto it = lower_bound(nodes_, m.first); it != nodes_.end() && it->first == missing; ++it) ++missing;
  if (missing >= kAbaqusAssembly)
    file_.draft.fail(m.place,
                     "*NSET: node {} is not defined in the assembly; for a node of an instance give INSTANCE=name",
                     missing - kAbaqusAssembly);
  file_.draft.fail(m.place, "*NSET: node {} is not defined in *NODE", missing);
}

void AbaqusLookup::append_nodes_of_elements(const AbaqusMembers& m, std::vector<FileNodeUse>& uses) {
  const auto use = [&](std::int64_t node) {
    count_visit(m.place);
    uses.push_back({node, m.place});
  };
  const AbaqusMembers elements{.set = m.set, .place = m.place};
  each_cell(elements, [&](std::size_t c) {
    const FileCell& cell = file_.draft.cells[c];
    for (const std::int64_t node : cell.corners()) use(node);
    if (cell.midsides) std::for_each(cell.midsides->begin(), cell.midsides->end(), use);
    for (const FileEdge& edge : cell.edges) use(edge.middle);
  });
  each_face(elements, [&](std::size_t f) {
    for (const std::int64_t node : file_.faces[f].corners()) use(node);
    std::for_each(file_.face_middles[f].begin(), file_.face_middles[f].end(), use);
  });
}

const Vec3& AbaqusLookup::position(std::int64_t node, FilePlace place) const {
  const auto found = lower_bound(nodes_, node);
  if (found == nodes_.end() || found->first != node)
    file_.draft.fail(place, "node {} is not defined in *NODE", node % kAbaqusAssembly);
  return file_.draft.nodes[found->second].x;
}

std::size_t AbaqusLookup::count_undefined(const AbaqusSet& set) const {
  std::size_t missing = 0;
  for (const AbaqusMembers& m : set.members) {
    if (!m.listed || !m.set.empty()) continue;
    const auto defined = [&](const Numbers& numbers) {
      return static_cast<std::size_t>(lower_bound(numbers, m.last + 1) - lower_bound(numbers, m.first));
    };
    missing += count_of(m) - std::min(count_of(m), defined(cells_) + defined(faces_) + defined(ignored_));
  }
  return missing;
}

}  // namespace orthodyn
