// The names and paths of a sweep, checked.
#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <string_view>

#include "lib/study/sweep/formula_scope.h"
#include "lib/study/sweep/sweep.h"

namespace orthodyn {

namespace {

// The columns of sweep.csv beside those of variables and metrics; those that a metric of this cost has are left out.
constexpr std::string_view kTableColumns[] = {"point",       "status", "reason",   "message", "wall_seconds",
                                              "cpu_seconds", "steps",  "unknowns", "folder"};
// Columns beside that of a metric with a closed form: endings of its name.
constexpr const char* kBesideClosedForms[] = {".closed_form", ".relative_difference"};

using Places = std::map<std::string, SourceLocation>;  // by path or name

Places paths_of(const Variable& v) {
  if (!v.path.empty()) return {{v.path, v.origin}};
  Places paths;
  for (const auto& value : v.values)
    for (const auto& [path, set] : value.set) paths.emplace(path, set.origin);
  return paths;
}

// A later variable is set after an earlier one: what it replaces would still be told of the points.
void refuse_replaced_values(const Variable& earlier, const Variable& later) {
  for (const auto& [path, place] : paths_of(later)) {
    for (const auto& [other, other_place] : paths_of(earlier)) {
      if (path == other)
        place.fail(fmt::format("'{}' is set here and at {}: only one of the two can apply; remove one", path,
                               other_place.where));
      if (other.starts_with(path + "."))
        place.fail(fmt::format("'{}' replaces '{}', which is set at {}; put this one before it, or remove one", path,
                               other, other_place.where));
    }
  }
}

// Every formula, for what mentions a name.
std::vector<std::string> formulas_of(const Sweep& sweep) {
  std::vector<std::string> all;
  const auto add_texts = [&](const auto& list) {
    for (const auto& [path, value] : list)
      if (value.text.find('=') != std::string::npos) all.push_back(value.text);
  };
  for (const auto& [name, definition] : sweep.definitions) all.push_back(definition.text);
  for (const auto& [name, metric] : sweep.quantities) all.push_back(metric.closed_form);
  add_texts(sweep.scene.set);
  for (const auto& variable : sweep.vary) {
    for (const auto& value : variable.values) {
      for (const auto& [name, formula] : value.let) all.push_back(formula.text);
      add_texts(value.set);
    }
  }
  return all;
}

// A slip in a key's name would vary nothing.
void refuse_unused_names(const Sweep& sweep) {
  const auto formulas = formulas_of(sweep);
  const auto require = [&](const std::string& name, const SourceLocation& place) {
    if (std::none_of(formulas.begin(), formulas.end(), [&](const std::string& f) { return mentions(f, name); }))
      place.fail("'" + name + "' is not a key of a scene, and no formula uses it" + scene_key_near(name));
  };
  for (const auto& v : sweep.vary) {
    if (v.path.empty() && v.numeric()) require(v.name, v.origin);
    for (const auto& value : v.values)
      for (const auto& [name, formula] : value.let) require(name, formula.origin);
  }
}

void take(Places& taken, const std::string& name, const SourceLocation& place) {
  const auto [other, is_new] = taken.emplace(name, place);
  if (!is_new)
    place.fail(fmt::format("the name '{}' is taken at {}; formulas could not tell them apart: give another", name,
                           other->second.where));
}

void refuse_names_of_two_things(const Sweep& sweep) {
  Places taken;
  for (const auto& v : sweep.vary) taken.emplace(v.name, v.origin);  // each another, as they were read
  for (const auto& v : sweep.vary) {
    Places own;
    for (const auto& value : v.values)
      for (const auto& [name, formula] : value.let)
        if (name != v.name) own.emplace(name, formula.origin);  // a set has no number of its own
    for (const auto& [name, place] : own) take(taken, name, place);
  }
  for (const auto& [name, definition] : sweep.definitions) take(taken, name, definition.origin);
}

bool is_blank(const std::string& name) { return name.find_first_not_of(' ') == std::string::npos; }

// The table has a column for each variable and metric beside its own.
void refuse_equal_columns(const Sweep& sweep) {
  Places taken;
  const auto add = [&](const std::string& name, const SourceLocation& place) {
    if (is_blank(name)) place.fail("has no name; give one to head its column of the table");
    const auto [other, is_new] = taken.emplace(name, place);
    if (!is_new)
      place.fail(
          fmt::format("the table already has a column '{}', of {}; give another name", name, other->second.where));
  };
  for (const auto& v : sweep.vary) add(v.name, v.origin);
  for (const auto& [name, f] : sweep.quantities) {
    add(name, f.origin);
    if (f.closed_form.empty()) continue;
    for (const char* ending : kBesideClosedForms) add(name + ending, f.origin);
  }
  for (const auto& [name, place] : taken) {
    const auto is_cost = [&, &n = name](const auto& q) { return q.first == n && q.second.cost == n; };
    if (std::find(std::begin(kTableColumns), std::end(kTableColumns), name) == std::end(kTableColumns)) continue;
    if (std::any_of(sweep.quantities.begin(), sweep.quantities.end(), is_cost)) continue;  // the same column
    place.fail(fmt::format("the table has a column '{}' of its own; give another name", name));
  }
}

}  // namespace

void check_names(const Sweep& sweep) {
  for (auto later = sweep.vary.begin(); later != sweep.vary.end(); ++later)
    for (auto earlier = sweep.vary.begin(); earlier != later; ++earlier) refuse_replaced_values(*earlier, *later);
  refuse_unused_names(sweep);
  refuse_names_of_two_things(sweep);
  refuse_equal_columns(sweep);
}

}  // namespace orthodyn
