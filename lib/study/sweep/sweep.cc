#include "lib/study/sweep/sweep.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <stdexcept>

#include "lib/core/units.h"
#include "lib/core/words.h"
#include "lib/fem/fem_model.h"
#include "lib/simulation/input_kind.h"
#include "lib/study/sweep/formula_scope.h"
#include "lib/study/sweep/sweep_names.h"

namespace orthodyn {

template <>
struct Words<Impossible> {
  static constexpr std::array<std::pair<Impossible, const char*>, 2> list{
      {{Impossible::stop, "stop"}, {Impossible::keep, "keep"}}};
};

namespace {

void check_range(const NumberRange& r, const Config& config) {
  if (r.scale == Scale::log && !(r.from.number > 0 && r.to.number > 0))
    config.fail("scale: log needs 'from' and 'to' above 0");
}

void check_figure(const WantedFigure& f, const Config& config) {
  const int kinds = !f.quantity.empty() + (f.mode.has_value() || f.along.has_value()) + !f.cost.empty();
  if (kinds != 1) config.fail("give exactly one of: quantity, mode (or along), cost");
  if (f.mode && f.along) config.at("along").fail("finds a mode by itself; remove 'mode' or 'along'");
  check_take(f.take, f.at, f.of, config);
  if (f.quantity.empty()) f.check_unit("");
  if (f.settled_within && (f.at || f.take != Take::end))
    config.at("settled_within").fail("stands in place of 'take' and 'at'; remove them");
  const auto& costs = cost_names();
  if (f.cost.empty() || std::any_of(costs.begin(), costs.end(), [&](const auto& c) { return c.first == f.cost; }))
    return;
  std::vector<std::string> names;
  for (const auto& [name, unit] : costs) names.push_back(name);
  config.at("cost").fail("unknown cost '" + f.cost + "'" + did_you_mean(f.cost, names) + " Known: " + join(names));
}

std::vector<std::string> components_of(const OutputInfo& info) {
  static const std::vector<std::string> space{"xx", "yy", "zz", "xy", "yz", "zx"},
      material{"11", "22", "33", "12", "23", "31"};
  if (info.components == 3) return {"x", "y", "z", "magnitude"};
  if (info.components != 6) return {};
  std::vector<std::string> all = info.name == "stress" ? space : material;
  all.push_back("magnitude");
  if (info.name != "strain") all.push_back("von_mises");
  return all;
}

// As the drawing tool understands it: FIELD or FIELD.COMPONENT.
void check_color(const std::string& color, const Config& at) {
  const std::string field = color.substr(0, color.find('.'));
  std::vector<std::string> fields;
  for (const auto& info : FemModel{FemModel::Parts{}}.outputs()) {
    if (info.location == Location::global) continue;
    fields.push_back(info.name);
    if (info.name != field) continue;
    const auto known = components_of(info);
    if (color == field || std::find(known.begin(), known.end(), color.substr(field.size() + 1)) != known.end()) return;
    at.fail("'" + field + "' has no component '" + color.substr(field.size() + 1) + "'" +
            (known.empty() ? "; it is a number" : "; known: " + join(known)));
  }
  at.fail("there is no field '" + field + "'" + did_you_mean(field, fields) + " Known: " + join(fields));
}

void check_frames(const FrameWish& f, const Config& config) {
  check_color(f.color, config.at("color"));
  if (f.view.size() != 2)
    config.at("view").fail("expected two angles [azimuth, elevation] in degrees", InputFault::form);
  if (f.up != "x" && f.up != "y" && f.up != "z") config.at("up").fail("expected x, y or z, found '" + f.up + "'");
}

void check_plots(const Sweep& s, const Config& config) {
  for (std::size_t i = 0; i < s.plots.size(); ++i) {
    const auto& plot = s.plots[i];
    const Config at = config.at("plots").at(i);
    std::vector<std::string> figures, variables;
    for (const auto& [name, f] : s.quantities) figures.push_back(name);
    for (const auto& v : s.vary) variables.push_back(v.name);
    const auto require = [&](const std::string& key, const std::string& name, const std::vector<std::string>& known) {
      if (name.empty() || std::find(known.begin(), known.end(), name) != known.end()) return;
      at.at(key).fail("there is no '" + name + "'; known: " + join(known));
    };
    require("figure", plot.figure, figures);
    require("x", plot.x, variables);
    require("lines", plot.lines, variables);
  }
}

constexpr double kMostPoints = 1e6;

void check_number_of_points(const Sweep& s, const Config& config) {
  double points = 1;
  for (const auto& v : s.vary) points *= static_cast<double>(v.values.size());
  if (s.combine == Combine::cartesian && points > kMostPoints)
    config.at("vary").fail(
        fmt::format("every combination makes {:.3g} points, the most is {:.0g}; give fewer values, or combine: "
                    "latin_hypercube with 'samples'",
                    points, kMostPoints));
}

void check_sweep(const Sweep& s, const Config& config) {
  if (s.quantities.empty()) config.at("quantities").fail("is empty; name at least one figure");
  if (s.combine != Combine::latin_hypercube) {
    const std::string only = "has a meaning only with combine: latin_hypercube, found combine: " +
                             Value<Combine>::yaml(s.combine) + "; remove one of them";
    if (s.samples) config.at("samples").fail(only);
    if (s.seed) config.at("seed").fail(only);
  }
  for (const auto& v : s.vary) {
    if (s.combine == Combine::latin_hypercube) {
      if (v.range && v.range->count)
        v.origin.fail("a Latin hypercube has 'samples'; remove 'count'");
    } else if (v.range && !v.range->count) {
      v.origin.fail("key 'count' is missing: how many values from 'from' to 'to'");
    }
    if (s.combine == Combine::zip && v.values.size() != s.vary.front().values.size())
      v.origin.fail(fmt::format("combine: zip takes values side by side: '{}' has {}, '{}' {}", v.name, v.values.size(),
                                s.vary.front().name, s.vary.front().values.size()));
  }
  for (const auto& [name, value] : s.definitions) check_formula_name(name, config.at("definitions").at(name));
  check_names(s);
  check_number_of_points(s, config);
  check_plots(s, config);
}

}  // namespace

const std::vector<std::pair<std::string, std::string>>& cost_names() {
  static const std::vector<std::pair<std::string, std::string>> all = {
      {"cpu_seconds", "s"},   {"wall_seconds", "s"}, {"steps", ""},          {"rejected_steps", ""},
      {"newton_iterations", ""}, {"forces", ""},     {"tangents", ""},       {"factorizations", ""},
      {"solves", ""},         {"peak_memory", "bytes"}};
  return all;
}

std::string WantedFigure::unit_of(const std::string& quantity_unit) const {
  if (mode || along) return "Hz";
  if (settled_within) return "s";
  if (cost.empty()) return figure_unit(take, quantity_unit);
  for (const auto& [name, si] : cost_names())
    if (name == cost) return si;
  return "";
}

void WantedFigure::check_unit(const std::string& quantity_unit) const {
  if (unit.empty()) return;
  try {
    check_dimension(unit, unit_of(quantity_unit));
  } catch (const std::invalid_argument& e) {
    origin.fail("unit: '" + unit + "': " + e.what());
  }
}

namespace {
constexpr const char* kNameSentence =
    "Its name in formulas, tables and figures; default the path's last step, with the index of an entry (young.0).";
}  // namespace

const Spec<NumberRange>& NumberRange::spec() {
  static const auto s =
      Spec<NumberRange>()
          .key("from", &NumberRange::from, "The first value.", {.required = true})
          .key("to", &NumberRange::to, "The last value.", {.required = true})
          .key("count", &NumberRange::count, "How many, with both ends; not in a Latin hypercube.", {.range = {1, 1e6}})
          .key("scale", &NumberRange::scale, "log: neighbours have the same ratio, and axes are logarithmic.")
          .key("unit", &NumberRange::unit, "Unit of the values, such as deg or GPa; formulas see SI units. Or give 'from' and 'to' units of their own.")
          .key("name", &NumberRange::name, kNameSentence)
          .check(check_range);
  return s;
}

const Spec<ValueList>& ValueList::spec() {
  static const auto s =
      Spec<ValueList>()
          .key("values", &ValueList::values, "The values.", {.required = true})
          .key("unit", &ValueList::unit,
               "Unit of numbers, such as deg or GPa; formulas see SI units. Or give them units of their own.")
          .key("name", &ValueList::name, kNameSentence);
  return s;
}

const Spec<WantedFigure>& WantedFigure::spec() {
  static const auto s =
      Spec<WantedFigure>()
          .key("quantity", &WantedFigure::quantity,
               "A probe's field and component (tip.displacement.z) or a scalar of the whole body (energy.elastic), as "
               "in `expect` of a scene.")
          .key("take", &WantedFigure::take, kTakeSentence)
          .key("at", &WantedFigure::at, "The value at this time, in place of `take`.", {.unit = "s"})
          .key("of", &WantedFigure::of, kOfSentence, {.range = kPositive})
          .key(
              "settled_within", &WantedFigure::settled_within,
              "In place of `take`: the time after which the quantity stays within this fraction of its range about its "
              "last value. None if that is in the last tenth of the time span.",
              {.range = {0, 1, true, true}})
          .key("mode", &WantedFigure::mode, "A natural frequency in Hz by its number, rigid modes not counted.",
               {.range = {1, 1000}})
          .key("along", &WantedFigure::along,
               "A natural frequency: of the twenty lowest modes that with the largest effective mass along this axis.")
          .key("about_equilibrium", &WantedFigure::about_equilibrium,
               "Modes about the static equilibrium under the scene's loads, not about rest.")
          .key("cost", &WantedFigure::cost,
               "Of the computation: cpu_seconds, wall_seconds, steps, rejected_steps, newton_iterations, forces, "
               "tangents, factorizations, solves or peak_memory.")
          .key("title", &WantedFigure::title, "What it is called in figures; default its name.")
          .key("unit", &WantedFigure::unit, "The unit that it is shown in, such as mm; default SI.")
          .key("closed_form", &WantedFigure::closed_form,
               "A formula of the varied values and the definitions, in SI units: drawn as a line over the points.")
          .key("scale", &WantedFigure::scale, "Of its axis in figures.")
          .check(check_figure);
  return s;
}

const Spec<FrameWish>& FrameWish::spec() {
  static const auto s =
      Spec<FrameWish>()
          .key("at", &FrameWish::at, "The time of the pictures; default the end.", {.unit = "s"})
          .key("color", &FrameWish::color, "What colours the body: displacement, stress, strain, velocity, det_f.")
          .key("view", &FrameWish::view, "Azimuth and elevation of the eye, degrees.")
          .key("up", &FrameWish::up, "The axis that is up.")
          .key("enlarged", &FrameWish::enlarged, "Enlarges the deformation.", {.range = kPositive})
          .key("most", &FrameWish::most, "The most pictures; of more points some are chosen evenly.",
               {.range = {1, 100}})
          .key("ghost", &FrameWish::ghost, "Draw the outline of the rest shape as well.")
          .check(check_frames);
  return s;
}

const Spec<PlotWish>& PlotWish::spec() {
  static const auto s =
      Spec<PlotWish>()
          .key("figure", &PlotWish::figure, "One of `quantities`.", {.required = true})
          .key("x", &PlotWish::x, "The variable along the axis; default the one with most numbers.")
          .key("lines", &PlotWish::lines, "The variable with a line for each value; default the next.");
  return s;
}

const Spec<Sweep>& Sweep::spec() {
  static const auto s =
      Spec<Sweep>()
          .key("title", &Sweep::title, "Heading of the report; default the file's name.")
          .key("description", &Sweep::description, "What is varied and why, in a sentence or two.")
          .key("scene", &Sweep::scene,
               "A scene file, or a section {file, set}. In `set` a text \"=formula\" stands for its value.",
               {.required = true})
          .key("definitions", &Sweep::definitions,
               "Numbers and formulas by name, for other formulas; each may use the varied values and those above it.")
          .key("vary", &Sweep::vary,
               "Keys of the scene by path, or names of formulas, with their values: a list, {from, to, count, scale, "
               "unit}, {values, unit}, or named sets of keys {name: {path: value}}.",
               {.required = true})
          .key("combine", &Sweep::combine,
               "cartesian: every combination. zip: first with first, second with second. latin_hypercube: `samples` "
               "points, each value's range in as many strata.")
          .key("samples", &Sweep::samples, "Points of a Latin hypercube; default 50.", {.range = {1, kMostPoints}})
          .key("seed", &Sweep::seed, "Of a Latin hypercube; default 1.")
          .key("quantities", &Sweep::quantities, "What is wanted of every point, by name.", {.required = true})
          .key("plots", &Sweep::plots, "Figures of the report; default by the number of variables.")
          .key("frames", &Sweep::frames, "A picture of each point, side by side.")
          .key("impossible", &Sweep::impossible,
               "Points whose scene cannot be (an unstable material). stop: an error before anything runs. keep: they "
               "are in the table, with the reason.")
          .key("limits", &Sweep::limits, "Of each point.")
          .check(check_sweep);
  return s;
}

Sweep read_sweep(const Config& config) {
  refuse_other_kinds(config, InputFile::sweep);
  Sweep sweep = Sweep::spec().read(config);
  sweep.name = std::filesystem::path(config.file()).stem().string();
  if (sweep.title.empty()) sweep.title = sweep.name;
  return sweep;
}

}  // namespace orthodyn
