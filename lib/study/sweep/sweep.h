// A sweep, as its YAML file says it: one scene, what is varied in it, and the figures that are wanted of every point.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "lib/fem/motion/component.h"
#include "lib/scene/expectation.h"
#include "lib/study/compare/comparison.h"

namespace orthodyn {

// How the values of several variables make points.
enum class Combine { cartesian, zip, latin_hypercube };
enum class Scale { linear, log };
enum class Impossible { stop, keep };

template <>
struct Words<Combine> {
  static constexpr std::array<std::pair<Combine, const char*>, 3> list{
      {{Combine::cartesian, "cartesian"}, {Combine::zip, "zip"}, {Combine::latin_hypercube, "latin_hypercube"}}};
};

template <>
struct Words<Scale> {
  static constexpr std::array<std::pair<Scale, const char*>, 2> list{{{Scale::linear, "linear"}, {Scale::log, "log"}}};
};

// A number in a unit that is said elsewhere, or "10 MPa" with one of its own.
struct Amount {
  double number = 0;
  std::string unit;
};

template <>
struct Value<Amount> {
  static Shape shape() {
    return {.kind = Shape::Kind::either, .items = {{.kind = Shape::Kind::number}, {.kind = Shape::Kind::text}}};
  }
  static Amount read(const Config& c, const Rule&);
  static std::string yaml(const Amount&) { return ""; }
};

// Evenly spaced numbers: differences, resp. ratios of neighbours are the same.
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

// One value of a variable. Numbers are SI in formulas, and in the variable's own unit where people see them.
struct VariedValue {
  std::string label;             // what people read: "30", "coarse"
  std::optional<double> number;  // in the variable's unit
  std::vector<std::pair<std::string, YamlText>> set;  // keys of the scene; a text "=formula" stands for its value
  std::vector<std::pair<std::string, YamlText>> let;  // further variables of formulas
};

// What is varied: a key of the scene by its path, or a name of which formulas make use, or named sets of keys.
struct Variable {
  std::string name;  // in formulas, tables and figures
  std::string path;  // "" for one that formulas use
  std::string unit;
  Scale scale = Scale::linear;
  std::optional<NumberRange> range;  // of a Latin hypercube: not divided yet
  std::vector<VariedValue> values;
  Origin origin;

  bool numeric() const;
  double si(double number) const;  // of a number in the variable's unit
  VariedValue at(double number) const;
};

// One figure of a point. Exactly one of: quantity, mode, cost.
struct WantedFigure {
  std::string quantity;
  Take take = Take::end;
  std::optional<double> at, of, settled_within;
  std::optional<int> mode;
  std::optional<Component> along;  // in place of the mode's number: that with the largest effective mass along it
  bool about_equilibrium = false;
  std::string cost;
  std::string title, unit, closed_form;
  Scale scale = Scale::linear;
  Origin origin;
  static const Spec<WantedFigure>& spec();

  bool is_of_motion() const { return !quantity.empty() || !cost.empty(); }
  // Its SI unit, where its quantity has the given one; "" for a plain number.
  std::string unit_of(const std::string& quantity_unit) const;
  // Throws ConfigError if it cannot be shown in `unit`.
  void check_unit(const std::string& quantity_unit) const;
};

// A picture of each point.
struct FrameWish {
  std::optional<double> at;  // s; default the end
  std::string color = "displacement";
  std::vector<double> view{-60, 20};
  std::string up = "z";
  double enlarged = 1;
  int most = 24;
  bool ghost = true;
  Origin origin;
  static const Spec<FrameWish>& spec();
};

// A figure of the report; without any, it has what the number of variables suggests.
struct PlotWish {
  std::string figure, x, lines;
  static const Spec<PlotWish>& spec();
};

struct Sweep {
  std::string name;  // the file's stem
  std::string title, description;
  SceneEntry scene;
  Named<YamlText> definitions;  // numbers and formulas
  Combine combine = Combine::cartesian;
  std::optional<int> samples;  // of a Latin hypercube
  std::optional<long> seed;
  std::vector<Variable> vary;
  Named<WantedFigure> quantities;
  std::vector<PlotWish> plots;
  std::optional<FrameWish> frames;
  Impossible impossible = Impossible::stop;
  Limits limits;
  Origin origin;
  static const Spec<Sweep>& spec();
};

// Throws ConfigError.
Sweep read_sweep(const Config& config);

// What a point can have cost, by name: "cpu_seconds", "steps", ... with their units.
const std::vector<std::pair<std::string, std::string>>& cost_names();

// The variables, in the order of the file.
template <>
struct Value<std::vector<Variable>> {
  static Shape shape();
  static std::vector<Variable> read(const Config& c, const Rule&);
  static std::string yaml(const std::vector<Variable>&) { return ""; }
};

}  // namespace orthodyn
