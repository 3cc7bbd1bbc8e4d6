// The variables of a sweep: its section `vary`.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "lib/study/inputs/assignments.h"
#include "lib/study/quantities/wanted_metric.h"

namespace orthodyn {

// A number with its own unit ("10 MPa"), or without a unit.
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

// Evenly spaced numbers: constant difference, or constant ratio with scale: log.
struct NumberRange {
  Amount from, to;
  std::optional<int> count;  // empty in a Latin hypercube
  Scale scale = Scale::linear;
  std::string unit, name;
  static const Spec<NumberRange>& spec();
};

// The number at `share` of the range: `from` at 0, `to` at 1.
double range_at(const NumberRange& range, double share);

// A list of values, all in one unit.
struct ValueList {
  std::vector<YamlText> values;
  std::string unit, name;
  static const Spec<ValueList>& spec();
};

// Throws ConfigError at `at` for an unknown unit; "" is allowed.
void check_unit(const std::string& unit, const Config& at);

// Converts "10 MPa" to the given unit; empty if the text is not a quantity of the unit's dimension.
std::optional<double> number_in(const std::string& text, const std::string& unit);

// Reads a range and converts both ends to one unit: that of the section, otherwise that of `from`.
NumberRange read_number_range(const Config& c);

// One value of a variable. Numbers are in the variable's unit; formulas use SI.
struct VariedValue {
  std::string label;             // "30", "coarse"
  std::optional<double> number;  // in the variable's unit
  Assignments set;               // scene keys; a text "=formula" is replaced by its value
  Assignments definitions;       // named numbers that the formulas of this variable may use
};

// A variable: a scene key by path, a name used in formulas, or named sets of keys.
struct Variable {
  std::string name;  // in formulas, tables and plots
  std::string path;  // "" for a name or for sets of keys
  std::string unit;
  Scale scale = Scale::linear;
  std::optional<NumberRange> range;
  std::vector<VariedValue> values;
  SourceLocation origin;

  bool numeric() const;                 // true if every value is a number
  double si(double number) const;       // from the variable's unit to SI
  VariedValue at(double number) const;  // the value `number`, in the variable's unit
};

// The variables, in the order of the file.
template <>
struct Value<std::vector<Variable>> {
  static ValueSchema schema();
  static std::vector<Variable> read(const Config& c, const Rule&);
  static std::string yaml(const std::vector<Variable>&) { return ""; }
};

// Top-level keys of a scene. A key of `vary` without a dot is a path if it is one of these, otherwise a name for
// formulas.
std::vector<std::string> scene_keys();

// Suggestion for a misspelt top-level key: "; did you mean 'gravity'?", or "" if no key is similar.
std::string scene_key_near(const std::string& name);

}  // namespace orthodyn
