#include "lib/study/inputs/scene_variant.h"

#include "lib/study/inputs/integrator_entry.h"

namespace orthodyn {

namespace {

constexpr const char* kIntegrator = "integrator";

// Options of the scene's integrator that `kept` accepts and that the new integrator also has.
Assignments own_options(const Config& scene, const std::string& integrator,
                        const std::function<bool(const std::string&)>& kept) {
  Assignments out;
  if (!scene.has(kIntegrator) || !scene.at(kIntegrator).is_map()) return out;
  const Config own = scene.at(kIntegrator);
  for (const auto& key : own.keys())
    if (key != "type" && kept(key) && has_key(integrator, key))
      out.emplace_back(key, YamlText{own.at(key).yaml(), {own.at(key).where()}});
  return out;
}

std::string path_of(const std::string& option) { return std::string(kIntegrator) + "." + option; }

}  // namespace

Config with_integrator(const SceneVariant& variant, const std::string& integrator, const Assignments& options,
                       const std::function<bool(const std::string&)>& kept) {
  Config scene = Config::from_text(variant.text, variant.file).resolving();
  assign(scene, variant.set);
  const Assignments own = own_options(scene, integrator, kept);
  assign(scene, kIntegrator, {"{}"});
  scene.set(path_of("type"), integrator);
  for (const auto& [key, value] : own) assign(scene, path_of(key), value);
  for (const auto& [key, value] : options) assign(scene, path_of(key), value);
  return scene;
}

}  // namespace orthodyn
