#include "lib/mesh/io/abaqus_sets.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <set>
#include <utility>
#include <vector>

#include "lib/core/spelling.h"
#include "lib/mesh/io/text_tokens.h"

namespace orthodyn {
namespace {

constexpr std::size_t kMostWithin = 1000;

// Goes through sets of one kind, each once.
class SetsWithinSets {
 public:
  SetsWithinSets(const AbaqusSets& sets, const char* keyword, const MeshDraft& draft)
      : sets_(sets), keyword_(keyword), draft_(draft) {}

  // Returns how many sets are within each other there, at least 1.
  std::size_t visit(const AbaqusSet& set) {
    if (const auto known = depths_.find(&set); known != depths_.end()) return known->second;
    std::size_t depth = 1;
    path_.push_back(&set);
    for (const AbaqusMembers& m : set.members) {
      if (m.set.empty() || m.of_elements) continue;
      const AbaqusSet* inner = find_abaqus(sets_, m.set);
      if (!inner) continue;  // is refused where the set is used
      refuse_circle(*inner, m.place);
      if (path_.size() >= kMostWithin) fail_depth(m.place);
      depth = std::max(depth, 1 + visit(*inner));
      if (depth > kMostWithin) fail_depth(m.place);
    }
    path_.pop_back();
    return depths_[&set] = depth;
  }

 private:
  [[noreturn]] void fail_depth(FilePlace place) const {
    draft_.fail(place, fmt::format("{}: more than {} sets within each other", keyword_, kMostWithin));
  }

  void refuse_circle(const AbaqusSet& inner, FilePlace place) const {
    const auto begin = std::find(path_.begin(), path_.end(), &inner);
    if (begin == path_.end()) return;
    std::vector<std::string> names;
    for (auto it = begin; it != path_.end(); ++it) names.push_back((*it)->name);
    names.push_back(inner.name);
    draft_.fail(place, fmt::format("{}: set {} contains itself ({}); list its members instead", keyword_,
                                   TextTokens::quoted(inner.name), join(names, " has ")));
  }

  const AbaqusSets& sets_;
  const char* keyword_;
  const MeshDraft& draft_;
  std::map<const AbaqusSet*, std::size_t> depths_;
  std::vector<const AbaqusSet*> path_;  // each has the next
};

class SolidsOfSet {
 public:
  explicit SolidsOfSet(const AbaqusFile& file) : file_(file) {}

  void add(const std::string& key) {
    const AbaqusSet* set = find_abaqus(file_.element_sets, key);
    if (!set || !seen_.insert(set).second) return;
    for (const AbaqusMembers& m : set->members)
      if (m.set.empty()) add(m);
      else add(m.set);
  }
  std::set<std::int64_t> take() { return std::move(found_); }

 private:
  void add(const AbaqusMembers& m) {
    for (const FileCell& cell : file_.draft.cells)
      if (cell.tag >= m.first && cell.tag <= m.last && (cell.tag - m.first) % m.step == 0) found_.insert(cell.tag);
  }

  const AbaqusFile& file_;
  std::set<const AbaqusSet*> seen_;
  std::set<std::int64_t> found_;
};

}  // namespace

void refuse_circles_of_sets(const AbaqusFile& file) {
  SetsWithinSets elements(file.element_sets, "*ELSET", file.draft), nodes(file.node_sets, "*NSET", file.draft);
  for (const auto& [key, set] : file.element_sets) elements.visit(set);
  for (const auto& [key, set] : file.node_sets) nodes.visit(set);
}

std::set<std::int64_t> solids_of_set(const AbaqusFile& file, const std::string& key) {
  SolidsOfSet solids(file);
  solids.add(key);
  return solids.take();
}

}  // namespace orthodyn
