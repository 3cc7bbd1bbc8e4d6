#include "lib/mesh/io/abaqus_history.h"

#include <fmt/format.h>

#include <cctype>
#include <utility>

#include "lib/core/spelling.h"

namespace orthodyn {
namespace {

// A set or surface of a condition; returns its key.
template <class Thing>
std::string make_own(const std::string& keyword, std::map<std::string, Thing>& things) {
  std::string name = keyword;
  for (char& c : name) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  for (int k = 1;; ++k) {
    Thing own{.name = fmt::format("{}_{}", name, k)};
    own.of_condition = true;
    const std::string key = in_capitals(own.name);
    if (things.emplace(key, std::move(own)).second) return key;
  }
}

}  // namespace

void AbaqusHistoryReader::read(const AbaqusKeyword& keyword) {
  const std::string& name = keyword.name;
  if (name == "STEP") file_.steps.push_back(keyword);
  if (name == "STATIC" || name == "DYNAMIC" || name == "VISCO" || name == "COUPLEDTEMPERATURE-DISPLACEMENT")
    read_period();
  if (name == "AMPLITUDE")
    file_.amplitudes[in_capitals(keyword.parameter("NAME"))] = read_abaqus_amplitude(keyword, lines_);
  if (name == "TRANSFORM")
    file_.transforms.push_back(read_abaqus_transform(keyword, scopes_.now().key(keyword.parameter("NSET")),
                                                     scopes_.now().placement.R, lines_));
  if (name == "BOUNDARY" || name == "CLOAD" || name == "DLOAD" || name == "DSLOAD") read_conditions(keyword);
}

// The second number of a procedure; without one, or with zero, a step lasts 1 s.
void AbaqusHistoryReader::read_period() {
  if (file_.steps.size() != 1 || lines_.at_keyword()) return;
  const auto& fields = lines_.data();
  const double period = fields.size() > 1 ? abaqus_number(fields[1]).value_or(0) : 0;
  if (period > 0) file_.first_period = period;
}

void AbaqusHistoryReader::read_conditions(const AbaqusKeyword& keyword) {
  std::map<std::string, std::string> made;  // by what stands behind the numbers: the key of their set
  while (!lines_.at_keyword()) {
    const auto fields = lines_.data();
    if (fields.empty()) continue;
    AbaqusCondition condition{keyword, file_.steps.size(), "", {fields.begin() + 1, fields.end()}, lines_.place()};
    if (fields[0].empty() || gather(condition, scopes_.member(fields[0]), made))
      file_.conditions.push_back(std::move(condition));
  }
}

bool AbaqusHistoryReader::gather(AbaqusCondition& condition, const AbaqusMembers& members,
                                 std::map<std::string, std::string>& made) {
  const std::string& name = condition.keyword.name;
  const std::string label = condition.fields.empty() ? "" : abaqus_word(condition.fields[0]);
  const bool of_faces = name == "DLOAD" && label.size() == 2 && label[0] == 'P' && label[1] >= '1' && label[1] <= '6';
  condition.target = members.set;
  if (!of_faces && (!members.set.empty() || name == "DLOAD" || name == "DSLOAD")) return true;
  const auto [found, is_new] = made.try_emplace(join(condition.fields));
  if (is_new) found->second = of_faces ? make_own(name, file_.surfaces) : make_own(name, file_.node_sets);
  condition.target = found->second;
  if (of_faces) file_.surfaces[found->second].faces.push_back({members, static_cast<std::size_t>(label[1] - '1')});
  else file_.node_sets[found->second].members.push_back(members);
  return is_new;
}

}  // namespace orthodyn
