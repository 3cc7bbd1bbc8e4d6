#include "lib/study/fit/problem.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <utility>

#include "lib/core/spelling.h"
#include "lib/core/units.h"
#include "lib/simulation/run/scene_file.h"
#include "lib/simulation/sensitivity/motion_sensitivity.h"
#include "lib/simulation/sensitivity/scene_parameter.h"
#include "lib/study/sweep/key_unit.h"

namespace orthodyn::study::fit {

namespace {

double si_value(const YamlText& value, const std::string& unit) {
  try {
    return read_number(parsed(value), {.unit = unit});
  } catch (const ConfigError& e) {
    throw ConfigError(value.origin.where, e.what());
  }
}

// Throws ConfigError at `origin` unless the value is a number of the scene's model that can change by a little.
void require_parameter(const Config& scene, const std::string& path, const SourceLocation& origin) {
  constexpr std::array kOthers{"analysis", "buckling", "checkpoint", "events", "expect",       "integrator",
                               "output",   "statics",  "threads",    "time",   "sensitivities"};
  const std::string section = path.substr(0, path.find('.'));
  if (std::find(kOthers.begin(), kOthers.end(), section) != kOthers.end())
    origin.fail(fmt::format("'{}' is no number of the body, its loads or its supports", path));
  try {
    require_changeable(scene, SceneParameter(scene, path));
  } catch (const ConfigError& e) {
    origin.fail(fmt::format("'{}' cannot be a parameter: {}", path, e.message()));
  }
}

// Throws ConfigError if two parameters have the same path, or one the path of a section and the other one in it.
void require_different_paths(const Fit& fit) {
  std::map<std::string, std::string> known;
  for (const auto& [name, parameter] : fit.parameters) {
    std::vector<std::string> paths = parameter.also;
    paths.push_back(parameter.path);
    for (const std::string& path : paths)
      if (const auto [other, is_new] = known.emplace(path, name); !is_new)
        parameter.origin.fail(fmt::format("'{}' is also the path of the parameter '{}'", path, other->second));
  }
  for (const auto& [path, name] : known)
    for (const auto& [inner, other] : known)
      if (inner.starts_with(path + "."))
        fit.origin.fail(
            fmt::format("'{}', the path of the parameter '{}', is a part of '{}', that of '{}': leave out one of them",
                        inner, other, path, name));
}

}  // namespace

Problem::Problem(const Fit& fit) : limits_(fit.limits) {
  require_different_paths(fit);
  prepare(fit.experiments, false);
  prepare(fit.candidates, true);
  for (const auto& [name, parameter] : fit.parameters) add_parameter(name, parameter);
  add_nuisances(fit);
  if (fit.intervals == Intervals::profile && single_parameters().empty())
    fit.origin.fail("intervals: profile is for single parameters, and this fit has only a field; remove it");
  std::vector<PathOfParameter> paths;
  for (std::size_t p = 0; p < parameters_.size(); ++p)
    for (const std::string& path : parameters_[p].paths)
      for (const PreparedExperiment& experiment : experiments_)
        if (has_value_at(experiment.scene, path)) paths.push_back({p, path, experiment.scene});
  set_intervals(coordinates_, paths);
  require_enough_data(fit);
}

bool PreparedExperiment::has_modes_only() const {
  return std::none_of(data.begin(), data.end(), [](const Datum& datum) { return datum.metric.is_of_motion(); });
}

void Problem::prepare(const Named<Experiment>& experiments, bool are_candidates) {
  for (const auto& [name, experiment] : experiments) {
    Config scene = Config::from_file(experiment.scene.file.path);
    refuse_other_kinds(scene, InputFile::scene);
    assign(scene, experiment.scene.set);
    const auto is_of_motion = [](const Measurement& m) { return !m.mode && m.frequencies.empty(); };
    const bool has_motion = std::any_of(experiment.measured.begin(), experiment.measured.end(), is_of_motion);
    if (!has_motion && scene.is_map() && !scene.has("time") && !scene.has("analysis"))
      scene.set("time.end", 1.0, "time.end of a scene of natural frequencies");  // needed, but without effect
    Data data = data_of(experiment, scene.resolving());
    experiments_.push_back(
        {name, scene, std::move(data.data), std::move(data.matchings), std::move(data.series), {}, are_candidates});
  }
}

namespace {

// Throws ConfigError for keys that a field does not have, and for data that are not computed with fields.
void check_field(const std::string& name, const Parameter& parameter,
                 const std::vector<PreparedExperiment>& experiments) {
  const SourceLocation& origin = parameter.origin;
  if (name == "data" || name == "parameters" || name.find_first_of("/\\") != std::string::npos || name.starts_with("."))
    origin.fail(
        fmt::format("the factors are written to '{}.csv': give the field another name, without / and a leading "
                    "full stop, and not data or parameters",
                    name));
  if (!parameter.smoothness)
    origin.fail(
        "key 'smoothness' is missing: the standard deviation of the logarithm of the ratio of neighbouring factors, "
        "such as 0.1; without it, a fit has more parameters than data");
  if (!parameter.also.empty()) origin.fail("'also' is not available for a field; remove it");
  if (parameter.scale) origin.fail("'scale' has no effect on a field, whose factors are searched by their logarithms");
  for (const PreparedExperiment& experiment : experiments)
    for (const Datum& datum : experiment.data)
      if (is_field(parameter.path, experiment.scene) &&
          (datum.metric.at || has_value_at(experiment.scene, "harmonic") || !datum.has_derivatives))
        origin.fail(
            fmt::format("a field can be fitted to quantities in equilibrium and to natural frequencies; '{}' of "
                        "experiment '{}' is neither",
                        datum.title, experiment.name));
}

void require_few_cells(const ParameterField& field, const SourceLocation& origin) {
  constexpr std::size_t kMost = 2000;
  if (field.size() <= kMost) return;
  origin.fail(fmt::format(
      "the grid of '{}' has {} cells, and a fit finds at most {} factors, because its time grows with their "
      "cube: give a coarser grid",
      field.path, field.size(), kMost));
}

}  // namespace

std::vector<std::size_t> Problem::single_parameters() const {
  std::vector<std::size_t> out;
  for (std::size_t p = 0; p < parameters_.size(); ++p)
    if (std::ranges::none_of(fields_, [&](const auto& f) { return p >= f.first && p < f.first + f.size(); }))
      out.push_back(p);
  return out;
}

void Problem::add_field(const std::string& name, const Parameter& parameter, const Config& scene) {
  check_field(name, parameter, experiments_);
  for (PreparedExperiment& experiment : experiments_)
    if (is_field(parameter.path, experiment.scene)) fill_values(parameter.path, experiment.scene);
  ParameterField field = read_field(parameter.path, scene);
  require_few_cells(field, parameter.origin);
  field.name = name, field.first = parameters_.size(), field.smoothness = *parameter.smoothness;
  for (const PreparedExperiment& experiment : experiments_)
    if (is_field(parameter.path, experiment.scene) &&
        read_field(parameter.path, experiment.scene).factors.grid != field.factors.grid)
      parameter.origin.fail("the experiments have different grids of these factors");
  for (std::size_t cell = 0; cell < field.size(); ++cell) {
    FittedParameter fitted;
    fitted.name = fmt::format("{}.{}", name, cell + 1), fitted.origin = parameter.origin;
    fitted.paths = {fmt::format("{}.values.{}", parameter.path, cell)};
    fitted.start = parameter.start ? si_value(*parameter.start, "") : field.factors.all()[cell];
    if (parameter.lower) fitted.lower = si_value(*parameter.lower, "");
    if (parameter.upper) fitted.upper = si_value(*parameter.upper, "");
    if (parameter.prior) {
      fitted.prior = si_value(parameter.prior->value, "");
      fitted.deviation = si_value(parameter.prior->deviation, "");
      if (!(*fitted.deviation > 0)) parameter.origin.fail("prior: the deviation must be positive");
    }
    if (fitted.lower && fitted.upper && !(*fitted.lower < *fitted.upper))
      parameter.origin.fail("'lower' must be below 'upper'");
    if (!(fitted.start > 0) || fitted.lower.value_or(1) <= 0 || fitted.upper.value_or(1) <= 0)
      parameter.origin.fail("stiffness factors are positive: give a positive start, lower and upper");
    if (fitted.start < fitted.lower.value_or(fitted.start) || fitted.start > fitted.upper.value_or(fitted.start))
      parameter.origin.fail(fmt::format("the start {:.6g} is outside of the bounds", fitted.start));
    for (PreparedExperiment& experiment : experiments_) {
      experiment.paths.emplace_back();
      if (is_field(parameter.path, experiment.scene)) experiment.paths.back() = fitted.paths;
    }
    parameters_.push_back(std::move(fitted));
    coordinates_.add_log();
  }
  fields_.push_back(std::move(field));
}

void Problem::add_parameter(const std::string& name, const Parameter& parameter) {
  const auto with_field = std::ranges::find_if(
      experiments_, [&](const auto& e) { return !e.is_candidate && is_field(parameter.path, e.scene); });
  if (with_field != experiments_.end()) return add_field(name, parameter, with_field->scene);
  if (parameter.smoothness)
    parameter.origin.fail(fmt::format(
        "smoothness is for a field, whose path is that of a region's stiffness_factors; '{}' is none", parameter.path));
  FittedParameter fitted;
  fitted.name = name, fitted.paths = {parameter.path}, fitted.origin = parameter.origin;
  fitted.paths.insert(fitted.paths.end(), parameter.also.begin(), parameter.also.end());
  std::optional<Config> first;  // scene that has the path
  for (PreparedExperiment& experiment : experiments_) {
    std::vector<std::string>& own = experiment.paths.emplace_back();
    for (const std::string& path : fitted.paths) {
      if (!has_value_at(experiment.scene, path)) continue;
      require_parameter(experiment.scene, path, parameter.origin);
      own.push_back(path);
      const Scene scene = read_scene(experiment.scene);
      for (Datum& datum : experiment.data)
        if (datum.metric.at && !has_motion_sensitivity(experiment.scene, scene, {path})) datum.has_derivatives = false;
      if (!first && path == parameter.path && !experiment.is_candidate) first = experiment.scene;
    }
  }
  if (!first) {
    try {
      value_at(experiments_.front().scene, parameter.path);
    } catch (const ConfigError& e) {
      parameter.origin.fail(e.what());  // names the nearest key
    }
    parameter.origin.fail(fmt::format("no experiment has the number '{}'", parameter.path));
  }
  const SceneParameter in_scene(*first, parameter.path);
  const std::string si = in_scene.is_angle() ? "rad" : unit_at(parameter.path, *first);
  fitted.unit = in_scene.unit().empty() ? si : in_scene.unit();
  fitted.factor = in_scene.factor();
  fitted.start = parameter.start ? si_value(*parameter.start, si) : in_scene.value();
  if (parameter.lower) fitted.lower = si_value(*parameter.lower, si);
  if (parameter.upper) fitted.upper = si_value(*parameter.upper, si);
  // Axes are the same after half a turn. Without a bound a first step from a symmetric position may be many turns.
  if (in_scene.is_angle() && !parameter.lower) fitted.lower = fitted.start - std::numbers::pi / 2;
  if (in_scene.is_angle() && !parameter.upper) fitted.upper = fitted.start + std::numbers::pi / 2;
  // A forgotten unit.
  constexpr double kFar = 1e4;
  if (const double ratio = std::abs(fitted.start / in_scene.value());
      parameter.start && fitted.start != 0 && in_scene.value() != 0 && (ratio > kFar || ratio < 1 / kFar))
    parameter.origin.fail(
        fmt::format("the start {:.6g} {} is {:.1g} times the value {:.6g} {} of the scene: is its unit "
                    "missing?",
                    fitted.start / fitted.factor, fitted.unit, ratio, in_scene.value() / fitted.factor, fitted.unit));
  if (parameter.prior) {
    fitted.prior = si_value(parameter.prior->value, si);
    fitted.deviation = si_value(parameter.prior->deviation, si);
    if (!(*fitted.deviation > 0)) parameter.origin.fail("prior: the deviation must be positive");
  }
  if (fitted.lower && fitted.upper && !(*fitted.lower < *fitted.upper))
    parameter.origin.fail("'lower' must be below 'upper'");
  if (fitted.start < fitted.lower.value_or(fitted.start) || fitted.start > fitted.upper.value_or(fitted.start))
    parameter.origin.fail(
        fmt::format("the start {:.6g} {} is outside of the bounds", fitted.start / fitted.factor, fitted.unit));
  parameters_.push_back(fitted);
  add_coordinate(parameter, parameters_.back(), *first);
}

void Problem::add_coordinate(const Parameter& parameter, const FittedParameter& fitted, const Config& scene) {
  const SceneParameter in_scene(scene, parameter.path);
  if (is_poisson_ratio(parameter.path, scene) && parameter.also.empty()) {
    if (fitted.lower || fitted.upper || parameter.scale)
      parameter.origin.fail(
          "a Poisson's ratio is searched in the interval in which the material is stable: remove lower, upper and "
          "scale (a prior is allowed)");
    return coordinates_.add_ratio();
  }
  const bool is_log = parameter.scale ? *parameter.scale == Scale::log : fitted.start > 0 && !in_scene.is_angle();
  if (!is_log) return coordinates_.add_linear(in_scene.is_angle() || fitted.start == 0 ? 1 : std::abs(fitted.start));
  if (!(fitted.start > 0) || fitted.lower.value_or(1) <= 0 || fitted.upper.value_or(1) <= 0)
    parameter.origin.fail("scale: log needs positive values; give scale: linear");
  coordinates_.add_log();
}

void Problem::require_enough_data(const Fit& fit) const {
  const std::size_t priors = static_cast<std::size_t>(
      std::ranges::count_if(parameters_, [](const FittedParameter& p) { return p.prior.has_value(); }));
  const std::size_t values = data().size();
  std::size_t pairs = 0;
  for (const ParameterField& field : fields_) pairs += field.neighbours().size();
  if (values + priors + pairs >= parameters_.size()) return;
  fit.origin.fail(fmt::format("{}{} cannot determine {}: add measured values or priors, or fit fewer parameters",
                              counted(std::ssize(data()), "measured value"),
                              priors > 0 ? " and " + counted(static_cast<long>(priors), "prior") : "",
                              counted(std::ssize(parameters_), "parameter")));
}

std::vector<const Datum*> Problem::data(Experiments which) const {
  std::vector<const Datum*> out;
  for (const PreparedExperiment& experiment : experiments_)
    if (experiment.is_candidate == (which == Experiments::candidates))
      for (const Datum& datum : experiment.data) out.push_back(&datum);
  return out;
}

Config Problem::scene_with(const PreparedExperiment& experiment, const Vector& values) const {
  Config scene = experiment.scene.copy();
  for (std::size_t p = 0; p < parameters_.size(); ++p)
    for (const std::string& path : experiment.paths[p]) {
      const SceneParameter parameter(scene, path);
      parameter.change(scene, values[static_cast<Eigen::Index>(p)] - parameter.value());
    }
  return scene;
}

}  // namespace orthodyn::study::fit
