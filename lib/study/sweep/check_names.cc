// Checks the names and paths of a sweep.
#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <string_view>

#include "lib/study/sweep/formula_scope.h"
#include "lib/study/sweep/sweep.h"

namespace orthodyn {

namespace {

// Columns of sweep.csv besides variables and metrics. A metric of the same cost replaces its column.
constexpr std::string_view kTableColumns[] = {"point",        "status",      "reason",  "message",
                                              "wall_seconds", "cpu_seconds", "steps",   "unknowns",
                                              "folder",       "mesh_error",  "warnings"};
// Suffixes of the additional columns of a metric with a closed form.
constexpr const char* kClosedFormColumns[] = {".closed_form", ".relative_difference"};

using Places = std::map<std::string, SourceLocation>;  // by path or name

Places paths_of(const Variable& v) {
  if (!v.path.empty()) return {{v.path, v.origin}};
  Places paths;
  for (const auto& value : v.values)
    for (const auto& [path, set] : value.set) paths.emplace(path, set.origin);
  return paths;
}

// Later variables are assigned after earlier ones. If a later variable replaced an earlier value, the table would still
// show the earlier value.
void refuse_replaced_values(const Variable& earlier, const Variable& later) {
  for (const auto& [path, place] : paths_of(later)) {
    for (const auto& [other, other_place] : paths_of(earlier)) {
      if (path == other)
        place.fail(fmt::format("'{}' is set here and at {}; remove one of the two", path, other_place.where));
      if (other.starts_with(path + "."))
        place.fail(fmt::format("'{}' replaces '{}', which is set at {}; put this one first, or remove one of the two",
                               path, other, other_place.where));
    }
  }
}

// All formulas of a sweep.
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
      for (const auto& [name, formula] : value.definitions) all.push_back(formula.text);
      add_texts(value.set);
    }
  }
  return all;
}

// A misspelled key would not vary anything.
void refuse_unused_names(const Sweep& sweep) {
  const auto formulas = formulas_of(sweep);
  const auto require = [&](const std::string& name, const SourceLocation& place) {
    if (std::none_of(formulas.begin(), formulas.end(), [&](const std::string& f) { return mentions(f, name); }))
      place.fail("'" + name + "' is not a key of a scene, and no formula uses it" + scene_key_near(name));
  };
  for (const auto& v : sweep.vary) {
    if (v.path.empty() && v.numeric()) require(v.name, v.origin);
    for (const auto& value : v.values)
      for (const auto& [name, formula] : value.definitions) require(name, formula.origin);
  }
}

void reserve(Places& taken, const std::string& name, const SourceLocation& place) {
  const auto [other, is_new] = taken.emplace(name, place);
  if (!is_new)
    place.fail(fmt::format("the name '{}' is already used at {}; formulas need unique names, so choose another", name,
                           other->second.where));
}

void refuse_ambiguous_names(const Sweep& sweep) {
  Places taken;
  for (const auto& v : sweep.vary) taken.emplace(v.name, v.origin);  // unique, as checked when reading
  for (const auto& v : sweep.vary) {
    Places own;
    for (const auto& value : v.values)
      for (const auto& [name, formula] : value.definitions)
        if (name != v.name)
          own.emplace(name, formula.origin);  // a variable of named sets has no number, so its name is free
    for (const auto& [name, place] : own) reserve(taken, name, place);
  }
  for (const auto& [name, definition] : sweep.definitions) reserve(taken, name, definition.origin);
}

bool is_blank(const std::string& name) { return name.find_first_not_of(' ') == std::string::npos; }

// Variables and metrics head columns of the table, whose names must be unique.
void refuse_equal_columns(const Sweep& sweep) {
  Places taken;
  const auto add = [&](const std::string& name, const SourceLocation& place) {
    if (is_blank(name)) place.fail("has a blank name; give a name for its column in the table");
    const auto [other, is_new] = taken.emplace(name, place);
    if (!is_new)
      place.fail(
          fmt::format("the table already has a column '{}', from {}; choose another name", name, other->second.where));
  };
  for (const auto& v : sweep.vary) add(v.name, v.origin);
  for (const auto& [name, m] : sweep.quantities) {
    add(name, m.origin);
    if (m.closed_form.empty()) continue;
    for (const char* ending : kClosedFormColumns) add(name + ending, m.origin);
  }
  for (const auto& [name, place] : taken) {
    const auto is_cost = [&, &n = name](const auto& q) { return q.first == n && q.second.cost == n; };
    if (std::find(std::begin(kTableColumns), std::end(kTableColumns), name) == std::end(kTableColumns)) continue;
    if (std::any_of(sweep.quantities.begin(), sweep.quantities.end(), is_cost)) continue;  // the same column
    place.fail(fmt::format("the table always has a column '{}'; choose another name", name));
  }
}

}  // namespace

void check_names(const Sweep& sweep) {
  for (auto later = sweep.vary.begin(); later != sweep.vary.end(); ++later)
    for (auto earlier = sweep.vary.begin(); earlier != later; ++earlier) refuse_replaced_values(*earlier, *later);
  refuse_unused_names(sweep);
  refuse_ambiguous_names(sweep);
  refuse_equal_columns(sweep);
}

}  // namespace orthodyn
