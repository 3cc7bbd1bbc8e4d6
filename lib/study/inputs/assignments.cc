#include "lib/study/inputs/assignments.h"

namespace orthodyn {

Config parsed(const YamlText& value) { return Config::from_text("v: " + value.text).at("v"); }

void assign(Config& scene, const std::string& path, const YamlText& value) {
  scene.set_yaml(path, value.text, value.origin.where);
}

void assign(Config& scene, const Assignments& assignments) {
  for (const auto& [path, value] : assignments) assign(scene, path, value);
}

}  // namespace orthodyn
