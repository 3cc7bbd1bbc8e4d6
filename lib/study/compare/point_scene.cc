// The scene of a point or of a reference: a problem's, with another integrator.
#include <algorithm>
#include <functional>
#include <set>

#include "lib/config/registry.h"
#include "lib/ode/integrator.h"
#include "lib/scene/scene.h"
#include "lib/study/compare/expand.h"

namespace orthodyn {

namespace {

using Keys = std::set<std::string>;

// Options of the scene's own integrator that the new one has too, but for the named ones, resp. only those.
Assignments own_options(const Config& scene, const std::string& integrator,
                        const std::function<bool(const std::string&)>& wanted) {
  Assignments kept;
  if (!scene.has("integrator") || !scene.at("integrator").is_map()) return kept;
  const Config own = scene.at("integrator");
  for (const auto& key : own.keys())
    if (key != "type" && wanted(key) && has_key(integrator, key))
      kept.emplace_back(key, YamlText{own.at(key).yaml(), {own.at(key).where()}});
  return kept;
}

bool is_kept_by_methods(const std::string& key, Method::Control control) {
  static const Keys controls{"rtol", "step", "safety"}, limits_of_steps{"h0", "h_min", "h_max"};
  return !controls.contains(key) && !(control == Method::Control::step && limits_of_steps.contains(key));
}

bool is_kept_by_references(const std::string& key) {
  static const Keys kept{"position_scale", "velocity_scale", "linear_solver"};
  return kept.contains(key);
}

void set_integrator(Config& config, const std::string& type, const Assignments& options) {
  config.set("integrator", Config::from_text("{}"));
  config.set("integrator.type", type);
  Keys seen;
  // The last assignment of a key holds.
  for (auto it = options.rbegin(); it != options.rend(); ++it)
    if (seen.insert(it->first).second)
      config.set_yaml("integrator." + it->first, it->second.text, it->second.origin.where);
}

Config scene_of(const Problem& problem, const std::string& integrator,
                const std::function<bool(const std::string&)>& kept, const Assignments& options) {
  Config config = with_integrator(problem, integrator, options, kept);
  config.set("output.fields", std::vector<std::string>());
  for (const char* key : {"output.energy", "output.steps", "output.momentum"}) config.set(key, false);
  config.set("expect", nullptr);
  read_scene(config);
  return config;
}

}  // namespace

bool has_key(const std::string& integrator, const std::string& key) {
  const auto& keys = Registry<IntegratorChoice>::entries().at(integrator).keys;
  return std::any_of(keys.begin(), keys.end(), [&](const Key& k) { return k.name == key; });
}

Config with_integrator(const Problem& problem, const std::string& integrator, const Assignments& options,
                       const std::function<bool(const std::string&)>& kept) {
  Config config = Config::from_text(problem.text, problem.file).resolving();
  for (const auto& [path, value] : problem.set) config.set_yaml(path, value.text, value.origin.where);
  Assignments all = own_options(config, integrator, kept);
  all.insert(all.end(), options.begin(), options.end());
  set_integrator(config, integrator, all);
  return config;
}

Config reference_scene(const Problem& problem, const Method& method) {
  return scene_of(problem, method.integrator, is_kept_by_references, method.set);
}

Config point_scene(const Design& design, const Point& point) {
  const Method& method = design.methods[point.method];
  Assignments options = method.set;
  options.emplace_back(control_word(method.control), YamlText{number_text(point.control)});
  const auto kept = [&](const std::string& key) { return is_kept_by_methods(key, method.control); };
  return scene_of(design.problems[point.problem], method.integrator, kept, options);
}

}  // namespace orthodyn
