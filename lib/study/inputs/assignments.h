// Changes that a study's file makes to a scene: values of scene keys by path.
#pragma once

#include <string>

#include "lib/config/spec.h"

namespace orthodyn {

// YAML text passed on unchanged as the value of a scene key.
struct YamlText {
  std::string text;
  SourceLocation origin = {};
};

template <>
struct Value<YamlText> {
  static ValueSchema schema() { return {}; }
  static YamlText read(const Config& c, const Rule&) { return {c.yaml(), {c.where()}}; }
  static std::string yaml(const YamlText& x) { return x.text; }
};

// Values by the path of their scene key.
using Assignments = Named<YamlText>;

// Parses the text. Throws ConfigError if it is not YAML.
inline Config parsed(const YamlText& value) { return Config::from_text("v: " + value.text).at("v"); }

// Set one key of a scene, or several in order. Throw ConfigError if a value is not YAML, or as Config::set() does.
// Missing sections are created.
inline void assign(Config& scene, const std::string& path, const YamlText& value) {
  scene.set_yaml(path, value.text, value.origin.where);
}
inline void assign(Config& scene, const Assignments& assignments) {
  for (const auto& [path, value] : assignments) assign(scene, path, value);
}

}  // namespace orthodyn
