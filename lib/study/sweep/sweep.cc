#include "lib/study/sweep/sweep.h"

#include <fmt/format.h>

#include <algorithm>

#include "lib/simulation/run/scene_file.h"
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
    for (const auto& [name, m] : s.quantities) metrics.push_back(name);
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

constexpr double kMostPoints = 1e7;  // above a million, the program requires --yes

void check_number_of_points(const Sweep& s, const Config& config) {
  double points = 1;
  for (const auto& v : s.vary) points *= static_cast<double>(v.values.size());
  if (s.combine == Combine::cartesian && points > kMostPoints)
    config.at("vary").fail(
        fmt::format("all combinations are {:.3g} points, more than the limit of {:.0g}; give fewer values, or use "
                    "combine: latin_hypercube with 'samples'",
                    points, kMostPoints));
}

void check_sweep(const Sweep& s, const Config& config) {
  if (s.quantities.empty()) config.at("quantities").fail("is empty; name at least one metric");
  if (s.combine != Combine::latin_hypercube) {
    const std::string only =
        "is only used with combine: latin_hypercube, found combine: " + Value<Combine>::yaml(s.combine) +
        "; remove one of them";
    if (s.samples) config.at("samples").fail(only);
    if (s.seed) config.at("seed").fail(only);
  }
  for (const auto& v : s.vary) {
    if (s.combine == Combine::latin_hypercube) {
      if (v.range && v.range->count)
        v.origin.fail("'count' is not used in a Latin hypercube, which has 'samples'; remove it");
    } else if (v.range && !v.range->count) {
      v.origin.fail("key 'count' is missing: the number of values from 'from' to 'to'");
    }
    if (s.combine == Combine::zip && v.values.size() != s.vary.front().values.size())
      v.origin.fail(fmt::format("combine: zip needs equally many values: '{}' has {}, '{}' has {}", v.name,
                                v.values.size(), s.vary.front().name, s.vary.front().values.size()));
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
          .key("description", &Sweep::description, "One or two sentences for the report: what is varied, and why.")
          .key("scene", &Sweep::scene,
               "A scene file, or a section {file, set}. In `set`, a text \"=formula\" is replaced by its value.",
               {.required = true})
          .key(
              "definitions", &Sweep::definitions,
              "Named numbers and formulas for use in formulas; each may use the varied values and earlier definitions.")
          .key("vary", &Sweep::vary,
               "Keys of the scene by path, or names used in formulas, with their values: a list, {from, to, count, "
               "scale, unit}, {values, unit}, or named sets of keys {name: {path: value}}.",
               {.required = true})
          .key("combine", &Sweep::combine,
               "cartesian: all combinations. zip: first values together, second values together, and so on. "
               "latin_hypercube: `samples` points, one in each stratum of every variable.")
          .key("samples", &Sweep::samples, "Number of points of a Latin hypercube; default 50.",
               {.range = {1, kMostPoints}})
          .key("seed", &Sweep::seed, "Seed of a Latin hypercube; default 1.")
          .key("quantities", &Sweep::quantities, "Metrics of every point, by name.", {.required = true})
          .key("plots", &Sweep::plots, "Plots of the report; default by the number of variables.")
          .key("frames", &Sweep::frames, "Show pictures of the points side by side.")
          .key("impossible", &Sweep::impossible,
               "Treatment of points with an invalid scene, such as an unstable material. stop: an error before "
               "anything runs. keep: the table lists them with the reason.")
          .key("limits", &Sweep::limits, "Wall time and memory limits of each point.")
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
