#include "lib/mesh/io/abaqus_sets.h"

#include <algorithm>
#include <map>
#include <set>
#include <utility>
#include <vector>

#include "lib/core/spelling.h"
#include "lib/mesh/io/text_tokens.h"

namespace orthodyn {
namespace {

constexpr std::size_t kMaxSetDepth = 1000;

// Visits sets of one kind, each once.
class NestedSets {
 public:
  NestedSets(const AbaqusSets& sets, const char* keyword, const MeshDraft& draft)
      : sets_(sets), keyword_(keyword), draft_(draft) {}

  // Returns the depth of nesting, at least 1.
  std::size_t visit(const AbaqusSet& set) {
    if (const auto known = depths_.find(&set); known != depths_.end()) return known->second;
    std::size_t depth = 1;
    path_.push_back(&set);
    for (const AbaqusMembers& m : set.members) {
      if (m.set.empty() || m.of_elements) continue;
      const AbaqusSet* inner = find_abaqus(sets_, m.set);
      if (!inner) continue;  // reported where the set is used
      refuse_cycle(*inner, m.place);
      if (path_.size() >= kMaxSetDepth) fail_depth(m.place);
      depth = std::max(depth, 1 + visit(*inner));
      if (depth > kMaxSetDepth) fail_depth(m.place);
    }
    path_.pop_back();
    return depths_[&set] = depth;
  }

 private:
  [[noreturn]] void fail_depth(FilePlace place) const {
    draft_.fail(place, "{}: sets are nested more than {} deep", keyword_, kMaxSetDepth);
  }

  void refuse_cycle(const AbaqusSet& inner, FilePlace place) const {
    const auto begin = std::find(path_.begin(), path_.end(), &inner);
    if (begin == path_.end()) return;
    std::vector<std::string> names;
    for (auto it = begin; it != path_.end(); ++it) names.push_back((*it)->name);
    names.push_back(inner.name);
    draft_.fail(place, "{}: set {} contains itself ({}); list its members instead", keyword_,
                TextTokens::quoted(inner.name), join(names, " contains "));
  }

  const AbaqusSets& sets_;
  const char* keyword_;
  const MeshDraft& draft_;
  std::map<const AbaqusSet*, std::size_t> depths_;
  std::vector<const AbaqusSet*> path_;  // each contains the next
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

AbaqusSet& AbaqusSetReader::touch(const std::string& name, AbaqusSets& sets) {
  AbaqusSet& set =
      sets.try_emplace(scopes_.current().key(name), AbaqusSet{.name = name, .instance = scopes_.current().instance})
          .first->second;
  set.order = ++order_;
  return set;
}

void AbaqusSetReader::add(AbaqusMembers members, const std::string& name, AbaqusSets& sets) {
  AbaqusSet& set = touch(name, sets);
  // Consecutive numbers are stored as one range.
  if (!set.members.empty() && members.set.empty()) {
    AbaqusMembers& last = set.members.back();
    if (last.set.empty() && last.step == 1 && members.step == 1 && last.listed == members.listed &&
        members.first == members.last && members.first > last.last && members.first - 1 == last.last) {
      last.last = members.last;
      return;
    }
  }
  set.members.push_back(std::move(members));
}

void AbaqusSetReader::read(const AbaqusKeyword& keyword, const char* parameter, AbaqusSets& sets) {
  const std::string name = lines_.name_of(keyword, parameter);
  const AbaqusScope of_members =
      keyword.has("INSTANCE") ? scopes_.instance(keyword.parameter("INSTANCE")) : scopes_.current();
  touch(name, sets);
  if (keyword.name == "NSET" && keyword.has("ELSET"))
    add({.set = of_members.key(lines_.name_of(keyword, "ELSET")), .place = keyword.place, .of_elements = true}, name,
        sets);
  const bool generate = keyword.has("GENERATE");
  while (!lines_.at_keyword()) {
    const std::vector<std::string_view>& fields = lines_.data();
    if (generate) {
      add(read_range(fields, scopes_.offset_of(of_members)), name, sets);
      continue;
    }
    for (const std::string_view field : fields) add(scopes_.member(field, of_members), name, sets);
  }
}

AbaqusMembers AbaqusSetReader::read_range(const std::vector<std::string_view>& fields, std::int64_t offset) {
  AbaqusMembers range{.place = lines_.place()};
  if (fields.size() < 2 || fields.size() > 3)
    lines_.fail("{} numbers; GENERATE needs the first, the last and an increment", fields.size());
  range.first = lines_.integer(fields[0], "the first number");
  range.last = lines_.integer(fields[1], "the last number");
  if (fields.size() == 3) range.step = lines_.integer(fields[2], "the increment");
  if (range.step == 0 && range.first == range.last) range.step = 1;
  if (range.step < 1 || range.first < 0 || range.last < range.first)
    lines_.fail("from {} to {} by {}; the numbers must ascend", range.first, range.last, range.step);
  if (offset > 0) {
    range.last = std::min(range.last, kAbaqusAssembly) + offset;
    range.first += offset;
  }
  return range;
}

void check_set_nesting(const AbaqusFile& file) {
  NestedSets elements(file.element_sets, "*ELSET", file.draft), nodes(file.node_sets, "*NSET", file.draft);
  for (const auto& [key, set] : file.element_sets) elements.visit(set);
  for (const auto& [key, set] : file.node_sets) nodes.visit(set);
}

std::set<std::int64_t> solids_of_set(const AbaqusFile& file, const std::string& key) {
  SolidsOfSet solids(file);
  solids.add(key);
  return solids.take();
}

}  // namespace orthodyn
