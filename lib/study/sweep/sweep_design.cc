#include "lib/study/sweep/sweep_design.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <stdexcept>

#include "lib/core/units.h"
#include "lib/scene/build.h"
#include "lib/scene/quantity.h"
#include "lib/simulation/harmonic/response_columns.h"
#include "lib/study/sweep/formula_scope.h"
#include "lib/study/sweep/key_unit.h"
#include "lib/study/sweep/latin_hypercube.h"

namespace orthodyn::study::sweep {

namespace {

using Values = std::vector<VariedValue>;

std::vector<Values> cartesian(const std::vector<Variable>& vary) {
  std::vector<Values> all{{}};
  for (const auto& variable : vary) {
    std::vector<Values> longer;
    for (const auto& values : all) {
      for (const auto& value : variable.values) {
        longer.push_back(values);
        longer.back().push_back(value);
      }
    }
    all = std::move(longer);
  }
  return all;
}

std::vector<Values> zipped(const std::vector<Variable>& vary) {
  std::vector<Values> all(vary.front().values.size());
  for (std::size_t i = 0; i < all.size(); ++i)
    for (const auto& variable : vary) all[i].push_back(variable.values[i]);
  return all;
}

constexpr int kDefaultSamples = 50;

std::vector<Values> sampled(const Sweep& sweep) {
  std::vector<Values> all;
  for (const auto& shares : latin_hypercube(sweep.samples.value_or(kDefaultSamples),
                                            static_cast<int>(sweep.vary.size()), sweep.seed.value_or(1))) {
    all.emplace_back();
    for (std::size_t k = 0; k < shares.size(); ++k) {
      const Variable& v = sweep.vary[k];
      if (v.range) all.back().push_back(v.at(range_at(*v.range, shares[k])));
      else all.back().push_back(v.values[static_cast<std::size_t>(shares[k] * static_cast<double>(v.values.size()))]);
    }
  }
  return all;
}

std::vector<Values> combined(const Sweep& sweep) {
  switch (sweep.combine) {
    case Combine::cartesian: return cartesian(sweep.vary);
    case Combine::zip: return zipped(sweep.vary);
    case Combine::latin_hypercube: break;
  }
  return sampled(sweep);
}

std::string title_of(const Sweep& sweep, const Values& values) {
  std::vector<std::string> parts;
  for (std::size_t k = 0; k < values.size(); ++k) {
    const Variable& v = sweep.vary[k];
    parts.push_back(v.name + " " + values[k].label + (v.unit.empty() || !values[k].number ? "" : " " + v.unit));
  }
  return join(parts);
}

class Expansion {
 public:
  explicit Expansion(const Sweep& sweep) : sweep_(sweep), scene_(read_scene_text(sweep.scene.file)) {}

  // Called before any point is read, because the first point may have the angle 0, which needs no unit.
  void require_units_of_angles() const {
    Config config = Config::from_text(scene_, sweep_.scene.file.path);
    for (const auto& [path, value] : sweep_.scene.set) assign(config, path, value);
    for (const Variable& v : sweep_.vary)
      if (v.unit.empty() && !v.path.empty() && v.numeric() && unit_at(v.path, config) == "rad")
        v.origin.fail("an angle needs a unit: add unit: deg or unit: rad");
  }

  Config scene(const Values& values) const {
    Config config = Config::from_text(scene_, sweep_.scene.file.path);
    set(config, values, scope_of(values));
    return config;
  }

  Point point(const Values& values) {
    Point point{values, title_of(sweep_, values), {}, "", {}};
    const FormulaScope scope = scope_of(values);
    for (const auto& [name, metric] : sweep_.quantities)
      point.closed_forms.push_back(
          metric.closed_form.empty() ? std::nan("") : scope.evaluate(metric.closed_form, metric.origin.where));
    Config config = Config::from_text(scene_, sweep_.scene.file.path).resolving();
    try {
      set(config, values, scope);
    } catch (const ConfigError& e) {
      throw ConfigError(e.place(), fmt::format("{} (in {})", e.message(), point.title));
    }
    std::optional<Scene> scene;
    try {
      scene = read_scene(config);
      point.scene = point_scene(config, point.title);
    } catch (const ConfigError& e) {
      point.impossible = e.what();
      if (sweep_.impossible == Impossible::stop)
        throw ConfigError(e.place(),
                          fmt::format("{} (in {}{})", e.message(), point.title,
                                      e.fault() == InputFault::form
                                          ? ""
                                          : "; with impossible: keep, the sweep continues without such points"));
    }
    if (scene) check_times(*scene, point.title);
    if (scene && !are_quantities_checked_) try_to_check_quantities(*scene);
    return point;
  }

  // If no scene could be built so far: the error of the first one; else "".
  const std::string& build_error() const { return build_error_; }

 private:
  FormulaScope scope_of(const Values& values) const {
    FormulaScope scope;
    for (std::size_t k = 0; k < values.size(); ++k)
      if (values[k].number && is_identifier(sweep_.vary[k].name))
        scope.add(sweep_.vary[k].name, sweep_.vary[k].si(*values[k].number));
    for (std::size_t k = 0; k < values.size(); ++k)
      for (const auto& [name, value] : values[k].definitions) scope.add(name, number_of(value, scope));
    for (const auto& [name, value] : sweep_.definitions) scope.add(name, number_of(value, scope));
    return scope;
  }

  // SI value of a quantity such as "0.84 GPa" or of a formula.
  static double number_of(const YamlText& value, const FormulaScope& scope) {
    const Config given = parsed(value);
    if (!given.is_scalar()) value.origin.fail("expected a number or a formula, found " + given.shown());
    const auto parts = split_quantity(given.text());
    try {
      if (parts) return parts->number * si_factor(parts->unit);
    } catch (const std::invalid_argument&) {  // not a unit: evaluated as a formula
    }
    return scope.evaluate(given.text(), value.origin.where);
  }

  void set(Config& config, const Values& values, const FormulaScope& scope) const {
    Assignments assignments = sweep_.scene.set;
    for (const auto& value : values) assignments.insert(assignments.end(), value.set.begin(), value.set.end());
    for (const auto& [path, value] : assignments) {
      const Config given = parsed(value);
      assign(config, path, {scope.resolved(given, value.origin.where), value.origin});
      add_radians(config, path, given, scope, value.origin);
    }
  }

  // Formulas give SI values. Because angles in a scene need a unit, the result of a formula for an angle gets "rad".
  static void add_radians(Config& config, const std::string& path, const Config& given, const FormulaScope& scope,
                          const SourceLocation& origin) {
    if (given.is_sequence())
      for (std::size_t i = 0; i < given.size(); ++i)
        add_radians(config, fmt::format("{}.{}", path, i), given.at(i), scope, origin);
    if (given.is_map())
      for (const auto& key : given.keys()) add_radians(config, path + "." + key, given.at(key), scope, origin);
    if (!given.is_scalar() || !given.text().starts_with("=") || unit_at(path, config) != "rad") return;
    const double angle = scope.evaluate(given.text().substr(1), origin.where);
    if (std::abs(angle) > 2 * std::numbers::pi && !mentions(given.text(), "pi"))
      origin.fail(
          fmt::format("the formula '{}' gives {:.6g} rad: formulas use SI units; if degrees are meant, give its "
                      "variables the unit deg, or multiply by pi/180",
                      given.text().substr(1), angle));
    assign(config, path, {number_text(angle) + " rad", origin});
  }

  static void check_analysis(const Scene& scene, const WantedMetric& m) {
    if (!scene.harmonic && m.is_of_response()) m.origin.fail("'response' and 'frequency' need analysis: harmonic");
    if (scene.harmonic && (m.at || m.take != TimeReduction::end || m.settled_within))
      m.origin.fail(
          "a harmonic analysis has no time: instead of take, at and settled_within, use response: amplitude, phase, "
          "peak or peak_frequency");
  }

  // Checked for every point, because the time span may be varied.
  void check_times(const Scene& scene, const std::string& title) const {
    const bool is_static = scene.is_static();
    const auto require = [&](const std::optional<double>& at, const std::string& place) {
      if (at && (*at < scene.time.start || *at > scene.time.end))
        throw ConfigError(place, fmt::format("{} s is outside the time span of '{}', {} to {} s", *at, title,
                                             scene.time.start, scene.time.end));
    };
    for (const auto& [name, m] : sweep_.quantities) {
      if (m.quantity.empty()) continue;
      check_analysis(scene, m);
      if (!is_static) require(m.at, m.origin.where + ".at");
      else if (scene.harmonic) continue;
      else if (m.at || m.take != TimeReduction::end || m.settled_within || m.quantity == kEnergyBalance)
        m.origin.fail(
            "a static analysis has only values in equilibrium: remove 'take', 'at' and 'settled_within', or choose "
            "another quantity than energy.balance");
    }
    if (!sweep_.frames || !sweep_.frames->at) return;
    if (scene.harmonic) sweep_.frames->origin.fail("a harmonic analysis has no picture; remove 'frames'");
    if (is_static) sweep_.frames->origin.fail("a static analysis has one picture, of the equilibrium: remove 'at'");
    require(sweep_.frames->at, sweep_.frames->origin.where + ".at");
  }

  // Checks the quantities in the first scene that can be built. A scene that cannot be built fails as a point.
  void try_to_check_quantities(const Scene& scene) {
    const auto wants = [](const auto& q) { return !q.second.quantity.empty(); };
    are_quantities_checked_ = std::none_of(sweep_.quantities.begin(), sweep_.quantities.end(), wants);
    if (are_quantities_checked_) return;
    std::optional<BuiltScene> built;
    try {
      built = build(scene);
    } catch (const ConfigError& e) {
      if (sweep_.impossible == Impossible::stop) throw;
      if (build_error_.empty()) build_error_ = e.what();
      return;
    }
    are_quantities_checked_ = true;
    build_error_.clear();
    check_quantities(scene, *built->model);
  }

  void check_quantities(const Scene& scene, const FemModel& model) const {
    for (const auto& [name, m] : sweep_.quantities) {
      if (m.quantity.empty()) continue;
      if (scene.harmonic) {
        const auto columns = response_columns(scene, model);
        m.check_unit(columns[find_column(columns, m.quantity, m.origin)].unit);
        continue;
      }
      const Quantity q = find_quantity(m.quantity, scene, model, m.origin);
      m.check_unit(q.unit);
      if (q.components() > 1 && !(q.is_vector() && m.take == TimeReduction::drift))
        m.origin.fail(q.ask_for_component());
    }
  }

  const Sweep& sweep_;
  std::string scene_;
  bool are_quantities_checked_ = false;
  std::string build_error_;
};

}  // namespace

double number_of_points(const Sweep& sweep) {
  if (sweep.combine == Combine::latin_hypercube) return sweep.samples.value_or(kDefaultSamples);
  if (sweep.combine == Combine::zip) return static_cast<double>(sweep.vary.front().values.size());
  double points = 1;
  for (const auto& variable : sweep.vary) points *= static_cast<double>(variable.values.size());
  return points;
}

Config first_scene(const Sweep& sweep) {
  const Expansion expansion(sweep);
  return expansion.scene(combined(sweep).front());
}

std::vector<Point> expand(const Sweep& sweep) {
  Expansion expansion(sweep);
  expansion.require_units_of_angles();
  std::vector<Point> points;
  for (const auto& values : combined(sweep)) points.push_back(expansion.point(values));
  if (std::all_of(points.begin(), points.end(), [](const Point& p) { return !p.impossible.empty(); }))
    throw ConfigError("none of the points can be computed; the first, " + points.front().title + ": " +
                      points.front().impossible);
  if (!expansion.build_error().empty())
    throw ConfigError("none of the points can be computed; " + expansion.build_error());
  return points;
}

}  // namespace orthodyn::study::sweep
