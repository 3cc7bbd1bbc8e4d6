#include "lib/study/sweep_design.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <optional>

#include "lib/scene/build.h"
#include "lib/scene/quantity.h"
#include "lib/study/formula_scope.h"
#include "lib/study/latin_hypercube.h"

namespace orthodyn {

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

std::vector<Values> side_by_side(const std::vector<Variable>& vary) {
  std::vector<Values> all(vary.front().values.size());
  for (std::size_t i = 0; i < all.size(); ++i)
    for (const auto& variable : vary) all[i].push_back(variable.values[i]);
  return all;
}

std::vector<Values> sampled(const Sweep& sweep) {
  std::vector<Values> all;
  for (const auto& shares : latin_hypercube(sweep.samples, static_cast<int>(sweep.vary.size()), sweep.seed)) {
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
    case Combine::zip: return side_by_side(sweep.vary);
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
  explicit Expansion(const Sweep& sweep) : sweep_(sweep) {
    Config::from_file(sweep.scene.file.path);  // says what is wrong with it
    std::ifstream in(sweep.scene.file.path, std::ios::binary);
    scene_.assign(std::istreambuf_iterator<char>(in), {});
  }

  SweepPoint point(const Values& values) {
    SweepPoint point{values, title_of(sweep_, values), "", "", {}, "", {}};
    const FormulaScope scope = scope_of(values);
    for (const auto& [name, figure] : sweep_.quantities)
      point.closed_forms.push_back(
          figure.closed_form.empty() ? std::nan("") : scope.evaluate(figure.closed_form, figure.origin.where));
    Config config = Config::from_text(scene_, sweep_.scene.file.path);
    set(config, sweep_.scene.set, scope, sweep_.scene.origin);
    for (std::size_t k = 0; k < values.size(); ++k) set(config, values[k].set, scope, sweep_.vary[k].origin);
    for (const char* silent : {"output.fields=[]", "output.energy=false", "output.steps=false", "output.momentum=false",
                               "expect=null", "checkpoint=null"})
      config.override_with(silent);
    try {
      const Scene scene = read_scene(config);
      fill(config, point);
      if (!read_) read_ = scene;
    } catch (const ConfigError& e) {
      if (sweep_.impossible == Impossible::stop)
        throw ConfigError(fmt::format("{}: {}: {} (impossible: keep goes on without such points)", sweep_.origin.where,
                                      point.title, e.what()));
      point.impossible = e.what();
    }
    if (read_ && !is_looked_up_) look_up_quantities(*read_);
    return point;
  }

 private:
  FormulaScope scope_of(const Values& values) const {
    FormulaScope scope;
    for (std::size_t k = 0; k < values.size(); ++k)
      if (values[k].number && is_identifier(sweep_.vary[k].name))
        scope.add(sweep_.vary[k].name, sweep_.vary[k].si(*values[k].number));
    for (std::size_t k = 0; k < values.size(); ++k)
      for (const auto& [name, value] : values[k].let)
        scope.add(name, scope.evaluate(unquoted(value.text), sweep_.vary[k].origin.where));
    for (const auto& [name, value] : sweep_.definitions)
      scope.add(name, scope.evaluate(unquoted(value.text), value.origin.where));
    return scope;
  }

  // The text of a YAML scalar.
  static std::string unquoted(const std::string& yaml) { return Config::from_text("v: " + yaml).at("v").text(); }

  template <class Settings>
  static void set(Config& config, const Settings& settings, const FormulaScope& scope, const Origin& origin) {
    for (const auto& [path, value] : settings) {
      const Config given = Config::from_text("v: " + value.text).at("v");
      config.override_with(path + "=" + scope.resolved(given, origin.where));
    }
  }

  static void fill(const Config& config, SweepPoint& point) {
    point.scene = config.dump_for("");
    point.mesh = config.at("mesh").yaml();
    point.files = config.file_paths();
  }

  void look_up_quantities(const Scene& scene) {
    is_looked_up_ = true;
    const auto wants = [](const auto& q) { return !q.second.quantity.empty(); };
    if (std::none_of(sweep_.quantities.begin(), sweep_.quantities.end(), wants)) return;
    const BuiltScene built = build(scene);
    for (const auto& [name, f] : sweep_.quantities) {
      if (f.quantity.empty()) continue;
      const Quantity q = find_quantity(f.quantity, scene, *built.model, f.origin);
      f.check_unit(q.unit);
      if (q.components == 3 && f.take != Take::drift)
        f.origin.fail(fmt::format("'{}' is a vector: choose .x, .y, .z or .magnitude", f.quantity));
      if (scene.analysis == Analysis::statical && (f.at || f.take != Take::end || f.settled_within || !q.values))
        f.origin.fail("of a static analysis only values in equilibrium are known: remove 'take', 'at' and "
                      "'settled_within', choose another quantity than energy.balance");
      if (f.at && (*f.at < scene.time.start || *f.at > scene.time.end))
        f.origin.fail(fmt::format("at: {} s is outside of the time span", *f.at));
    }
  }

  const Sweep& sweep_;
  std::string scene_;
  std::optional<Scene> read_;  // that of the first point that can be
  bool is_looked_up_ = false;
};

}  // namespace

std::vector<SweepPoint> expand(const Sweep& sweep) {
  Expansion expansion(sweep);
  std::vector<SweepPoint> points;
  for (const auto& values : combined(sweep)) points.push_back(expansion.point(values));
  if (std::all_of(points.begin(), points.end(), [](const SweepPoint& p) { return !p.impossible.empty(); }))
    throw ConfigError("none of the points can be computed; the first, " + points.front().title + ": " +
                      points.front().impossible);
  return points;
}

}  // namespace orthodyn
