#include "lib/simulation/run/scene_file.h"

#include <fmt/format.h>

#include <algorithm>

#include "lib/config/registry.h"
#include "lib/core/spelling.h"
#include "lib/ode/integrator.h"
#include "lib/simulation/run/input_kind.h"

namespace orthodyn {

namespace {

void change_integrator(Config& scene, const std::string& name, std::vector<std::string>& left_out) {
  const auto& known = Registry<IntegratorChoice>::entries();
  const auto entry = known.find(name);
  if (entry == known.end() || !scene.is_map() || !scene.has("integrator") || !scene.at("integrator").is_map())
    return scene.set("integrator.type", name, "--integrator");
  const Config before = scene.at("integrator").copy();
  const auto has = [&](const std::string& key) {
    return std::any_of(entry->second.keys.begin(), entry->second.keys.end(),
                       [&](const Key& k) { return k.name == key; });
  };
  Config section = Config::from_text("{}");
  section.set("type", name, "--integrator");
  for (const auto& key : before.keys()) {
    if (key == "type") continue;
    if (has(key)) section.set(key, before.at(key), before.at(key).where());
    else left_out.push_back(key);
  }
  scene.set("integrator", section);
}

}  // namespace

Config read_scene_file(const std::string& file, const SceneChanges& changes, std::vector<std::string>* left_out) {
  return changed_scene(Config::from_file(file), changes, left_out);
}

Config changed_scene(Config scene, const SceneChanges& changes, std::vector<std::string>* left_out) {
  refuse_other_kinds(scene, InputFile::scene);
  std::vector<std::string> dropped;
  if (changes.integrator) change_integrator(scene, *changes.integrator, dropped);
  if (left_out) *left_out = dropped;
  for (const auto& assignment : changes.set) scene.override_with(assignment);
  return scene;
}

std::string left_out_sentence(const std::vector<std::string>& left_out, const SceneChanges& changes) {
  if (left_out.empty()) return "";
  return fmt::format("integrator: {} {} no meaning for {} and {} left out", join(left_out),
                     left_out.size() == 1 ? "has" : "have", changes.integrator.value_or(""),
                     left_out.size() == 1 ? "is" : "are");
}

}  // namespace orthodyn
