#include "lib/study/compare/comparison_design.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <functional>
#include <map>
#include <set>

#include "lib/config/registry.h"
#include "lib/ode/integrator.h"
#include "lib/scene/scene.h"
#include "lib/simulation/run/kinematics.h"
#include "lib/study/compare/problem_groups.h"

namespace orthodyn::study::compare {

namespace {

constexpr const char* kIntegratorPrefix = "integrator.";
constexpr std::array kSafeties{0.9, 0.45, 0.225};

// All combinations of the values of those `vary` paths that `applies` accepts.
std::vector<Variant> combinations(const Comparison& comparison,
                                  const std::function<bool(const std::string&)>& applies) {
  std::vector<Variant> all{{}};
  for (const auto& [path, values] : comparison.vary) {
    if (!applies(path)) continue;
    std::vector<Variant> longer;
    for (const auto& variant : all) {
      for (const auto& value : values) {
        longer.push_back(variant);
        longer.back().set.emplace_back(path, value);
        longer.back().words += words_of(path, value);
      }
    }
    all = std::move(longer);
  }
  return all;
}

bool is_of_integrator(const std::string& path) { return path.starts_with(kIntegratorPrefix); }

// With a fixed step, rtol controls only Newton's method. It must be so tight that the step size determines the error.
YamlText newton_tolerance(const Comparison& comparison) {
  const auto& tolerances = comparison.tolerances;
  const double usual = 1e-6;
  if (tolerances.empty()) return {number_text(usual)};
  return {number_text(std::min(usual, *std::min_element(tolerances.begin(), tolerances.end()))),
          comparison.tolerances_at};
}

// Place in the file of the values that control the error.
SourceLocation origin_of(const Comparison& comparison, Method::Control control) {
  switch (control) {
    case Method::Control::rtol: return comparison.tolerances_at;
    case Method::Control::step: return comparison.steps_at;
    case Method::Control::safety: break;
  }
  return {};
}

// The kinds of error control that an integrator supports and the comparison requests.
struct Controls {
  bool adaptive, fixed, by_limit;
};

Controls controls_of(const Comparison& comparison, const IntegratorEntry& entry) {
  const bool has_tolerance = has_key(entry.type, "rtol");
  // Explicit methods without a tolerance determine the critical step themselves.
  const bool by_limit = has_key(entry.type, "safety") && !has_tolerance;
  return {has_tolerance && !comparison.tolerances.empty(),
          has_key(entry.type, "step") && !comparison.steps.empty() && !(by_limit && entry.by_all), by_limit};
}

// True for an option that this integrator has; other keys are not varied for it.
bool has_option(const IntegratorEntry& entry, const std::string& path) {
  return is_of_integrator(path) && has_key(entry.type, last_key(path));
}

// Adds one method per kind of error control.
void add_methods(const Comparison& comparison, const IntegratorEntry& entry, const Variant& variant,
                 std::vector<Method>& methods) {
  Method method{"",
                entry.label + variant.words,
                entry.type,
                Registry<IntegratorChoice>::entries().at(entry.type).sentence,
                entry.options,
                Method::Control::rtol};
  for (const auto& [path, value] : variant.set) method.set.emplace_back(last_key(path), value);
  const auto [adaptive, fixed, by_limit] = controls_of(comparison, entry);
  const std::string label = method.label;
  if (adaptive) methods.push_back(method);
  if (fixed) {
    method.control = Method::Control::step;
    if (adaptive) method.label = label + ", fixed step";
    if (has_key(entry.type, "rtol")) method.set.emplace_back("rtol", newton_tolerance(comparison));
    methods.push_back(method);
  }
  if (by_limit) {
    method.control = Method::Control::safety;
    method.label = label + (fixed ? ", share of the critical step" : "");
    methods.push_back(method);
  }
  if (!adaptive && !fixed && !by_limit && !entry.by_all)
    entry.origin.fail("'" + entry.type + "' needs " + (has_key(entry.type, "step") ? "'steps'" : "'tolerances'") +
                      ", which the comparison does not give; add them or remove the integrator");
}

std::vector<Method> methods_of(const Comparison& comparison) {
  std::vector<Method> methods;
  for (const auto& entry : comparison.integrators)
    for (const auto& variant : combinations(comparison, [&](const auto& path) { return has_option(entry, path); }))
      add_methods(comparison, entry, variant, methods);
  identify(methods);
  return methods;
}

// The integrator given for the reference or its check, or the default.
Method reference_method(const std::optional<CompleteIntegratorEntry>& entry, const Method& fallback) {
  if (!entry) return fallback;
  Method method{"", entry->type, entry->type, "", entry->options, Method::Control::rtol};
  for (const auto& [key, value] : entry->options) method.label += ", " + key + " " + value.text;
  return method;
}

Method default_reference(const std::string& type, double rtol, Assignments more) {
  more.emplace_back("rtol", YamlText{number_text(rtol)});
  Method method{"", type, type, "", more, Method::Control::rtol};
  for (const auto& [key, value] : more) method.label += ", " + key + " " + value.text;
  return method;
}

// Reads the scene, so that input errors are reported before anything runs.
void check_point(const Design& design, const Point& point) {
  try {
    point_scene(design, point);
  } catch (const ConfigError& e) {
    throw ConfigError(e.place(), fmt::format("{} (in {})", e.message(), title(design, point)));
  }
}

void check_reference(const Group& group, const Method& method) {
  try {
    reference_scene(group, method);
  } catch (const ConfigError& e) {
    throw ConfigError(e.place(), fmt::format("{} (in the reference of {})", e.message(), group.label));
  }
}

void choose_references(const Comparison& comparison, Design& design) {
  const auto& tolerances = comparison.tolerances;
  const double tightest = tolerances.empty() ? 1e-6 : *std::min_element(tolerances.begin(), tolerances.end());
  design.reference = reference_method(comparison.reference.integrator,
                                      default_reference("arkode_dirk", std::max(1e-3 * tightest, 1e-11), {}));
  design.check = reference_method(
      comparison.reference.check,
      default_reference("cvode_bdf", std::max(1e-3 * tightest, 1e-10), {{"max_order", YamlText{"5"}}}));
  if (comparison.reference.kind == ReferenceKind::none) return;
  for (const auto& group : design.groups) {
    check_reference(group, design.reference);
    check_reference(group, design.check);
  }
}

using Keys = std::set<std::string>;

bool is_kept_by_methods(const std::string& key, Method::Control control) {
  static const Keys controls{"rtol", "step", "safety"}, limits_of_steps{"h0", "h_min", "h_max"};
  return !controls.contains(key) && !(control == Method::Control::step && limits_of_steps.contains(key));
}

bool is_kept_by_references(const std::string& key) {
  static const Keys kept{"position_scale", "velocity_scale", "linear_solver"};
  return kept.contains(key);
}

void set_frames(const std::optional<KeptFrames>& frames, Config& config) {
  if (!frames) return config.set("output.fields", std::vector<std::string>());
  std::vector<std::string> fields = frames->fields;
  if (std::ranges::find(fields, "displacement") == fields.end()) fields.insert(fields.begin(), "displacement");
  config.set("output.fields", fields, frames->fields.origin.where);
  config.set("output.interval", nullptr);
  config.set("output.frames", static_cast<double>(frames->count));
}

Config scene_of(const std::optional<KeptFrames>& frames, const SceneVariant& variant, const std::string& integrator,
                const std::function<bool(const std::string&)>& kept, const Assignments& options) {
  Config config = with_integrator(variant, integrator, options, kept);
  set_frames(frames, config);
  for (const char* key : {"output.energy", "output.steps", "output.momentum"}) config.set(key, false);
  config.set("expect", nullptr);
  if (leaves_kinematics_open(read_scene(config)))
    config.at("elasticity")
        .fail(
            "kinematics: auto may choose a different model for each tolerance, but a comparison needs one model: set "
            "linear or corotational in the scene or in its `set`");
  return config;
}

}  // namespace

std::string control_word(Method::Control control) {
  switch (control) {
    case Method::Control::rtol: return "rtol";
    case Method::Control::step: return "step";
    case Method::Control::safety: break;
  }
  return "safety";
}

Config reference_scene(const Group& group, const Method& method, const std::optional<KeptFrames>& frames) {
  return scene_of(frames, group.reference, method.integrator, is_kept_by_references, method.set);
}

Config point_scene(const Design& design, const Point& point) {
  const Method& method = design.methods[point.method];
  Assignments options = method.set;
  options.emplace_back(control_word(method.control), YamlText{number_text(point.control), point.control_at});
  const auto kept = [&](const std::string& key) { return is_kept_by_methods(key, method.control); };
  return scene_of(design.frames, design.problems[point.problem].scene, method.integrator, kept, options);
}

std::string title(const Design& design, const Point& point) {
  const Method& method = design.methods[point.method];
  return fmt::format("{}, {}, {} {:g}", design.problems[point.problem].label, method.label,
                     control_word(method.control), point.control);
}

double number_of_points(const Comparison& comparison) {
  auto problems = static_cast<double>(comparison.scenes.size());
  for (const auto& [path, values] : comparison.vary)
    if (!is_of_integrator(path)) problems *= static_cast<double>(values.size());
  double each = 0;
  for (const auto& entry : comparison.integrators) {
    const Controls by = controls_of(comparison, entry);
    auto points = static_cast<double>((by.adaptive ? comparison.tolerances.size() : 0) +
                                      (by.fixed ? comparison.steps.size() : 0) + (by.by_limit ? kSafeties.size() : 0));
    for (const auto& [path, values] : comparison.vary)
      if (has_option(entry, path)) points *= static_cast<double>(values.size());
    each += points;
  }
  return problems * each;
}

Design expand(const Comparison& comparison) {
  Design design;
  design.frames = comparison.frames;
  add_problems(comparison, combinations(comparison, [](const auto& path) { return !is_of_integrator(path); }), design);
  design.methods = methods_of(comparison);
  std::map<Method::Control, std::vector<double>> controls{
      {Method::Control::rtol, comparison.tolerances},
      {Method::Control::step, comparison.steps},
      {Method::Control::safety, {kSafeties.begin(), kSafeties.end()}}};
  for (auto& [kind, values] : controls) std::sort(values.rbegin(), values.rend());
  for (std::size_t p = 0; p < design.problems.size(); ++p)
    for (std::size_t m = 0; m < design.methods.size(); ++m)
      for (const double control : controls.at(design.methods[m].control))
        design.points.push_back({p, m, control, origin_of(comparison, design.methods[m].control)});
  for (const auto& point : design.points) check_point(design, point);
  choose_references(comparison, design);
  return design;
}

}  // namespace orthodyn::study::compare
