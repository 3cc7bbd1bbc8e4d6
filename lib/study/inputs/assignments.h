// Changes to a scene, as a study's file gives them: values of the scene's keys by path.
#pragma once

#include <string>

#include "lib/config/spec.h"

namespace orthodyn {

// YAML that is handed on as it stands: a value for a key of a scene.
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

// Values of a scene by path, and where they come from: the place of what is wrong with them.
using Assignments = Named<YamlText>;

// The value as a node that can be read. Throws ConfigError for what is no YAML.
Config parsed(const YamlText& value);

// Sets one key, or all in their order: the last value of a key holds. Missing sections are made. Throws ConfigError.
void assign(Config& scene, const std::string& path, const YamlText& value);
void assign(Config& scene, const Assignments& assignments);

}  // namespace orthodyn
