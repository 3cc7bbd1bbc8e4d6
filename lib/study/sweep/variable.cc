#include "lib/study/sweep/variable.h"

#include <algorithm>
#include <cctype>
#include <set>
#include <stdexcept>

#include "lib/core/spelling.h"
#include "lib/core/units.h"
#include "lib/scene/scene.h"
#include "lib/study/sweep/formula_scope.h"

namespace orthodyn {

namespace {

bool is_path(const std::string& key) {
  const auto keys = scene_keys();
  return key.find('.') != std::string::npos || std::find(keys.begin(), keys.end(), key) != keys.end();
}

// The last key with its indices: "young.0".
std::string default_name(const std::string& path) {
  std::size_t begin = path.size();
  do {
    begin = begin == 0 ? 0 : path.rfind('.', begin - 1);
    if (begin == std::string::npos) return path;
  } while (begin > 0 && std::isdigit(static_cast<unsigned char>(path[begin + 1])) != 0);
  return path.substr(begin + 1);
}

// "30 deg"
std::string with_unit(double number, const std::string& unit) {
  return number_text(number) + (unit.empty() ? "" : " " + unit);
}

std::vector<double> values_of(const NumberRange& r) {
  const int n = r.count.value_or(0);
  std::vector<double> out;
  for (int i = 0; i < n; ++i) out.push_back(range_at(r, n == 1 ? 0 : static_cast<double>(i) / (n - 1)));
  return out;
}

bool is_unit(const std::string& unit) {
  try {
    return si_factor(unit) > 0;
  } catch (const std::invalid_argument&) {
    return false;
  }
}

void set_name(const std::string& name, const Config& c, Variable& v) {
  if (name.empty()) return;
  check_formula_name(name, c.at("name"));
  v.name = name;
}

void read_range(const Config& c, Variable& v) {
  const NumberRange r = read_number_range(c);
  v.unit = r.unit;
  v.scale = r.scale;
  set_name(r.name, c, v);
  v.range = r;
  for (const double x : values_of(r)) v.values.push_back(v.at(x));
}

// An entry of a list: a number, or any value that the scene key may have.
VariedValue listed_value(const Variable& v, const Config& c) {
  if (c.is_scalar() && c.reads_as_number()) return v.at(c.number());
  const auto number = c.is_scalar() && !v.unit.empty() ? number_in(c.text(), v.unit) : std::nullopt;
  if (v.path.empty() && number) return v.at(*number);
  if (v.path.empty())
    c.fail("'" + v.name + "' is not a key of a scene" + scene_key_near(v.name) +
           ", so its values must be numbers for formulas; found " + c.shown());
  VariedValue value{number ? number_text(*number) : c.is_scalar() ? c.text() : c.yaml(), number, {}, {}};
  value.set.emplace_back(v.path, Value<YamlText>::read(c, {}));
  return value;
}

// Unit of the first value with its own unit; "" if none has one.
std::string unit_in(const Config& list) {
  for (std::size_t i = 0; i < list.size(); ++i) {
    if (!list.at(i).is_scalar()) continue;
    const auto parts = split_quantity(list.at(i).text());
    if (parts && is_unit(parts->unit)) return parts->unit;
  }
  return "";
}

void read_list(const Config& list, Variable& v) {
  if (v.unit.empty()) {
    v.unit = unit_in(list);
    for (std::size_t i = 0; i < list.size() && !v.unit.empty(); ++i)
      if (list.at(i).reads_as_number())
        list.at(i).fail(
            "has no unit, but another value has one; give all of them a unit, or write {values: [...], unit: " +
            v.unit + "}");
  }
  for (std::size_t i = 0; i < list.size(); ++i) v.values.push_back(listed_value(v, list.at(i)));
}

// Reads {name: {path: value}}. A key that is not a path names a number for formulas.
void read_sets(const Config& c, Variable& v) {
  if (v.path.find('.') != std::string::npos)
    c.fail("expected a list of values, {from, to, count} or {values}, found " + c.shown());
  for (const auto& label : c.keys()) {
    const Config set = c.at(label);
    if (label.find_first_not_of(' ') == std::string::npos) set.fail("has a blank name; give the set a name");
    if (!set.is_map()) set.fail("expected a set of keys of the scene {path: value}, found " + set.shown());
    VariedValue value{label, {}, {}, {}};
    for (const auto& key : set.keys()) {
      auto& list = is_path(key) ? value.set : value.definitions;
      if (!is_path(key)) check_formula_name(key, set.at(key));
      list.emplace_back(key, Value<YamlText>::read(set.at(key), {}));
    }
    v.values.push_back(std::move(value));
  }
}

void refuse_repeated_values(const Variable& v, const Config& c) {
  std::set<double> numbers;
  std::set<std::string> others;
  for (const auto& value : v.values)
    if (!(value.number ? numbers.insert(*value.number).second : others.insert(value.label).second))
      c.fail("lists the value " + value.label + " twice");
}

Variable read_variable(const std::string& key, const Config& c) {
  Variable v;
  v.path = is_path(key) ? key : "";
  v.name = v.path.empty() ? key : default_name(key);
  v.origin.where = c.where();
  if (c.is_sequence()) {
    read_list(c, v);
  } else if (c.is_map() && c.has("from")) {
    read_range(c, v);
  } else if (c.is_map() && c.has("values")) {
    const ValueList list = ValueList::spec().read(c);
    check_unit(list.unit, c);
    v.unit = list.unit;
    set_name(list.name, c, v);
    read_list(c.at("values"), v);
  } else if (c.is_map()) {
    read_sets(c, v);
    v.path.clear();
  } else {
    c.fail("expected a list, {from, to, count}, {values} or named sets of keys, found " + c.shown());
  }
  if (!v.range && v.values.empty()) c.fail("is empty; list the values");
  // The default name of a list entry has a dot, so formulas cannot use it.
  if (v.path.empty() || is_identifier(v.name)) check_formula_name(v.name, c);
  refuse_repeated_values(v, c);
  return v;
}

}  // namespace

std::vector<std::string> scene_keys() {
  std::vector<std::string> names;
  for (const auto& key : Scene::spec().keys()) names.push_back(key.name);
  return names;
}

std::string scene_key_near(const std::string& name) { return did_you_mean(name, scene_keys()); }

bool Variable::numeric() const {
  return range || std::all_of(values.begin(), values.end(), [](const VariedValue& v) { return v.number.has_value(); });
}

double Variable::si(double number) const { return unit.empty() ? number : number * si_factor(unit); }

VariedValue Variable::at(double x) const {
  VariedValue value{number_text(x), x, {}, {}};
  if (!path.empty()) value.set.emplace_back(path, YamlText{with_unit(x, unit), origin});
  return value;
}

std::vector<Variable> Value<std::vector<Variable>>::read(const Config& c, const Rule&) {
  if (!c.is_map() || c.size() == 0) c.fail("expected variables {path: values}, found " + c.shown());
  std::vector<Variable> all;
  for (const auto& key : c.keys()) {
    all.push_back(read_variable(key, c.at(key)));
    for (std::size_t i = 0; i + 1 < all.size(); ++i)
      if (all[i].name == all.back().name)
        c.at(key).fail("the name '" + all.back().name +
                       "' is already used; choose another: {values: [...], name: ...}");
  }
  return all;
}

ValueSchema Value<std::vector<Variable>>::schema() {
  const ValueSchema list = list_schema({.kind = ValueSchema::Kind::anything});
  const ValueSchema sets{.kind = ValueSchema::Kind::named, .items = {{.kind = ValueSchema::Kind::anything}}};
  return {.kind = ValueSchema::Kind::named,
          .items = {{.kind = ValueSchema::Kind::either,
                     .words = "values",
                     .items = {list, Value<NumberRange>::schema(), Value<ValueList>::schema(), sets}}}};
}

}  // namespace orthodyn
