#include "lib/simulation/run/scene_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "lib/config/registry.h"
#include "lib/core/spelling.h"
#include "lib/ode/integrator.h"

namespace orthodyn {

namespace {

struct Mark {
  InputFile kind;
  const char *key, *words, *command;
};

constexpr std::array<Mark, 5> kMarks{{{InputFile::scene, "mesh", "a scene", "run"},
                                      {InputFile::comparison, "scenes", "a comparison", "compare"},
                                      {InputFile::sweep, "quantities", "a sweep", "sweep"},
                                      {InputFile::stability, "cases", "a file of hard cases", "stability"},
                                      {InputFile::fit, "experiments", "a fit", "fit"}}};

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

void refuse_other_kinds(const Config& config, InputFile wanted) {
  if (!config.is_map()) return;
  const auto has = [&](const Mark& mark) { return config.has(mark.key); };
  if (std::any_of(kMarks.begin(), kMarks.end(), [&](const Mark& m) { return m.kind == wanted && has(m); })) return;
  if (const auto other = std::find_if(kMarks.begin(), kMarks.end(), has); other != kMarks.end())
    throw ConfigError(config.file(), fmt::format("this is {}; run it with `orthodyn {} {}`", other->words,
                                                 other->command, config.file()));
}

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
  return fmt::format("integrator: {} {} not used by {} and {} left out", join(left_out),
                     left_out.size() == 1 ? "is" : "are", changes.integrator.value_or(""),
                     left_out.size() == 1 ? "is" : "are");
}

}  // namespace orthodyn
