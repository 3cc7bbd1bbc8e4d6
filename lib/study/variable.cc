// The section `vary` of a sweep.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "lib/core/parse_number.h"
#include "lib/core/units.h"
#include "lib/scene/scene.h"
#include "lib/study/formula_scope.h"
#include "lib/study/sweep.h"

namespace orthodyn {

namespace {

bool is_path(const std::string& key) {
  if (key.find('.') != std::string::npos) return true;
  const auto& keys = Scene::spec().keys();
  return std::any_of(keys.begin(), keys.end(), [&](const Key& k) { return k.name == key; });
}

std::string last_step(const std::string& path) { return path.substr(path.rfind('.') + 1); }

// "30" as it stands in a scene: "30 deg".
std::string with_unit(double number, const std::string& unit) {
  return number_text(number) + (unit.empty() ? "" : " " + unit);
}

std::vector<double> divided(const NumberRange& r) {
  const int n = r.count.value_or(0);
  std::vector<double> out;
  for (int i = 0; i < n; ++i) out.push_back(range_at(r, n == 1 ? 0 : static_cast<double>(i) / (n - 1)));
  return out;
}

void check_unit(const std::string& unit, const Config& at) {
  if (unit.empty()) return;
  try {
    si_factor(unit);
  } catch (const std::invalid_argument& e) {
    at.fail(e.what());
  }
}

void take_name(const std::string& name, const Config& c, Variable& v) {
  if (name.empty()) return;
  check_formula_name(name, c.at("name"));
  v.name = name;
}

void read_range(const Config& c, Variable& v) {
  const NumberRange r = NumberRange::spec().read(c);
  check_unit(r.unit, c);
  v.unit = r.unit;
  v.scale = r.scale;
  take_name(r.name, c, v);
  v.range = r;
  for (const double x : divided(r)) v.values.push_back(v.at(x));
}

// A scalar of a list: a number, or anything that a key of the scene can be.
VariedValue listed_value(const Variable& v, const Config& c) {
  if (c.is_scalar() && c.reads_as_number()) return v.at(c.number());
  if (v.path.empty()) c.fail("'" + v.name + "' is no key of a scene, so its values must be numbers for formulas");
  VariedValue value{c.is_scalar() ? c.text() : c.yaml(), {}, {}, {}};
  value.set.emplace_back(v.path, Value<YamlText>::read(c, {}));
  return value;
}

void read_list(const Config& list, Variable& v) {
  for (std::size_t i = 0; i < list.size(); ++i) v.values.push_back(listed_value(v, list.at(i)));
}

// {name: {path: value}}; what is no path is a variable of formulas.
void read_sets(const Config& c, Variable& v) {
  if (v.path.find('.') != std::string::npos)
    c.fail("a list of values, {from, to, count} or {values} belongs here; found " + c.shown());
  for (const auto& label : c.keys()) {
    const Config set = c.at(label);
    if (label.find_first_not_of(' ') == std::string::npos) set.fail("has no name; give one, which people read");
    if (!set.is_map()) set.fail("expected a set of keys of the scene {path: value}, found " + set.shown());
    VariedValue value{label, {}, {}, {}};
    for (const auto& key : set.keys()) {
      auto& list = is_path(key) ? value.set : value.let;
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
      c.fail("has the value " + value.label + " twice");
}

Variable read_variable(const std::string& key, const Config& c) {
  Variable v;
  v.path = is_path(key) ? key : "";
  v.name = v.path.empty() ? key : last_step(key);
  v.origin.where = c.where();
  if (c.is_sequence()) {
    read_list(c, v);
  } else if (c.is_map() && c.has("from")) {
    read_range(c, v);
  } else if (c.is_map() && c.has("values")) {
    const ValueList list = ValueList::spec().read(c);
    check_unit(list.unit, c);
    v.unit = list.unit;
    take_name(list.name, c, v);
    read_list(c.at("values"), v);
  } else if (c.is_map()) {
    read_sets(c, v);
    v.path.clear();
  } else {
    c.fail("expected a list, {from, to, count}, {values} or named sets of keys, found " + c.shown());
  }
  if (!v.range && v.values.empty()) c.fail("is empty; list the values");
  // The last step of a path may be a number, as of an entry of a list: then formulas do not see it.
  if (v.path.empty() || is_identifier(v.name)) check_formula_name(v.name, c);
  refuse_repeated_values(v, c);
  return v;
}

}  // namespace

bool Variable::numeric() const {
  return range || std::all_of(values.begin(), values.end(), [](const VariedValue& v) { return v.number.has_value(); });
}

double Variable::si(double number) const { return unit.empty() ? number : number * si_factor(unit); }

VariedValue Variable::at(double x) const {
  VariedValue value{number_text(x), x, {}, {}};
  if (!path.empty()) value.set.emplace_back(path, YamlText{with_unit(x, unit), origin});
  return value;
}

double range_at(const NumberRange& r, double share) {
  if (share == 0) return r.from;
  if (share == 1) return r.to;
  const double x = r.scale == Scale::log ? r.from * std::pow(r.to / r.from, share) : r.from + (r.to - r.from) * share;
  // Ends and their simple fractions stay what they look like: 0.3, not 0.30000000000000004.
  double simple = x;
  parse_number(fmt::format("{:.12g}", x), simple);
  return simple;
}

std::vector<Variable> Value<std::vector<Variable>>::read(const Config& c, const Rule&) {
  if (!c.is_map() || c.size() == 0) c.fail("expected what is varied {path: values}, found " + c.shown());
  std::vector<Variable> all;
  for (const auto& key : c.keys()) {
    all.push_back(read_variable(key, c.at(key)));
    for (std::size_t i = 0; i + 1 < all.size(); ++i)
      if (all[i].name == all.back().name)
        c.at(key).fail("the name '" + all.back().name + "' is taken; give another: {values: [...], name: ...}");
  }
  return all;
}

Shape Value<std::vector<Variable>>::shape() {
  const Shape list = list_shape({.kind = Shape::Kind::anything});
  const Shape sets{.kind = Shape::Kind::named, .items = {{.kind = Shape::Kind::anything}}};
  return {.kind = Shape::Kind::named,
          .items = {{.kind = Shape::Kind::either,
                     .words = "values",
                     .items = {list, Value<NumberRange>::shape(), Value<ValueList>::shape(), sets}}}};
}

}  // namespace orthodyn
