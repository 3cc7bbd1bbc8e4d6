// What a sweep varies, as the section `vary` says.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "lib/study/inputs/assignments.h"
#include "lib/study/quantities/wanted_metric.h"

namespace orthodyn {

// A number in a unit that is said elsewhere, or "10 MPa" with one of its own.
struct Amount {
  double number = 0;
  std::string unit;
};

template <>
struct Value<Amount> {
  static ValueSchema schema() {
    return {.kind = ValueSchema::Kind::either,
            .items = {{.kind = ValueSchema::Kind::number}, {.kind = ValueSchema::Kind::text}}};
  }
  static Amount read(const Config& c, const Rule&);
  static std::string yaml(const Amount&) { return ""; }
};

// Evenly spaced numbers: neighbours have the same difference, or the same ratio (scale: log).
struct NumberRange {
  Amount from, to;
  std::optional<int> count;  // none in a Latin hypercube, which has its own
  Scale scale = Scale::linear;
  std::string unit, name;
  static const Spec<NumberRange>& spec();
};

// From `from` at share 0 to `to` at share 1.
double range_at(const NumberRange& range, double share);

struct ValueList {
  std::vector<YamlText> values;
  std::string unit, name;
  static const Spec<ValueList>& spec();
};

// Throws ConfigError at `at` for what is no unit; "" is none.
void check_unit(const std::string& unit, const Config& at);

// "10 MPa" as a number of the unit; nothing for a text that is no such quantity.
std::optional<double> number_in(const std::string& text, const std::string& unit);

// Reads a range, with both ends in one unit: that of the section, or else of `from`.
NumberRange read_number_range(const Config& c);

// One value of a variable. Numbers are SI in formulas, and in the variable's own unit where people see them.
struct VariedValue {
  std::string label;             // what people read: "30", "coarse"
  std::optional<double> number;  // in the variable's unit
  Assignments set;               // keys of the scene; a text "=formula" stands for its value
  Assignments let;               // further variables of formulas
};

// What is varied: a key of the scene by its path, or a name of which formulas make use, or named sets of keys.
struct Variable {
  std::string name;  // in formulas, tables and metrics
  std::string path;  // "" for one that formulas use
  std::string unit;
  Scale scale = Scale::linear;
  std::optional<NumberRange> range;  // of a Latin hypercube: not divided yet
  std::vector<VariedValue> values;
  SourceLocation origin;

  bool numeric() const;
  double si(double number) const;  // of a number in the variable's unit
  VariedValue at(double number) const;
};

// The variables, in the order of the file.
template <>
struct Value<std::vector<Variable>> {
  static ValueSchema schema();
  static std::vector<Variable> read(const Config& c, const Rule&);
  static std::string yaml(const std::vector<Variable>&) { return ""; }
};

// The keys at the top of a scene: what tells a path from a name of formulas.
std::vector<std::string> scene_keys();

// "; did you mean 'gravity'?", or "".
std::string scene_key_near(const std::string& name);

}  // namespace orthodyn
