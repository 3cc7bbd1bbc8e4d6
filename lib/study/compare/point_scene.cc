// The scene of a point or of a reference: that of a problem or a group, with another integrator.
#include <algorithm>
#include <functional>
#include <set>

#include "lib/scene/scene.h"
#include "lib/simulation/run/kinematics.h"
#include "lib/study/compare/comparison_design.h"

namespace orthodyn::study::compare {

namespace {

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
            "kinematics: auto would choose a different model for each tolerance, and a comparison needs one model: set "
            "linear or "
            "corotational, in the scene or by its `set`");
  return config;
}

}  // namespace

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

}  // namespace orthodyn::study::compare
