#include "lib/study/sweep/sweep.h"

#include <fmt/format.h>

#include <algorithm>

#include "lib/simulation/run/input_kind.h"
#include "lib/study/inputs/labels.h"
#include "lib/study/sweep/formula_scope.h"

namespace orthodyn {

template <>
struct EnumNames<Impossible> {
  static constexpr std::array<std::pair<Impossible, const char*>, 2> list{
      {{Impossible::stop, "stop"}, {Impossible::keep, "keep"}}};
};

namespace {

void check_plots(const Sweep& s, const Config& config) {
  for (std::size_t i = 0; i < s.plots.size(); ++i) {
    const auto& plot = s.plots[i];
    const Config at = config.at("plots").at(i);
    std::vector<std::string> metrics, variables;
    for (const auto& [name, f] : s.quantities) metrics.push_back(name);
    for (const auto& v : s.vary) variables.push_back(v.name);
    const auto require = [&](const std::string& key, const std::string& name, const std::vector<std::string>& known) {
      if (name.empty() || std::find(known.begin(), known.end(), name) != known.end()) return;
      at.at(key).fail("there is no '" + name + "'; known: " + join(known));
    };
    require("metric", plot.metric, metrics);
    require("x", plot.x, variables);
    require("lines", plot.lines, variables);
  }
}

constexpr double kMostPoints = 1e7;  // a million asks for --yes

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
  if (s.quantities.empty()) config.at("quantities").fail("is empty; name at least one metric");
  if (s.combine != Combine::latin_hypercube) {
    const std::string only =
        "has a meaning only with combine: latin_hypercube, found combine: " + Value<Combine>::yaml(s.combine) +
        "; remove one of them";
    if (s.samples) config.at("samples").fail(only);
    if (s.seed) config.at("seed").fail(only);
  }
  for (const auto& v : s.vary) {
    if (s.combine == Combine::latin_hypercube) {
      if (v.range && v.range->count) v.origin.fail("a Latin hypercube has 'samples'; remove 'count'");
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
          .key("seed", &Sweep::seed, "Seed of a Latin hypercube; default 1.")
          .key("quantities", &Sweep::quantities, "What is computed for every point, by name.", {.required = true})
          .key("plots", &Sweep::plots, "Metrics of the report; default by the number of variables.")
          .key("frames", &Sweep::frames, "A picture of each point, side by side.")
          .key("impossible", &Sweep::impossible,
               "Points whose scene is impossible (an unstable material). stop: an error before anything runs. keep: "
               "they stay in the table, with the reason.")
          .key("limits", &Sweep::limits, "Limits of each point.")
          .check(check_sweep);
  return s;
}

Sweep read_sweep(const Config& config) {
  refuse_other_kinds(config, InputFile::sweep);
  Sweep sweep = Sweep::spec().read(config);
  sweep.name = stem(config.file());
  if (sweep.title.empty()) sweep.title = sweep.name;
  return sweep;
}

}  // namespace orthodyn
