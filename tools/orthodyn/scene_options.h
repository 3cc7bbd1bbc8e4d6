// Options and set-up of commands that take one scene.
#pragma once

#include <string>

#include "lib/simulation/run/scene_file.h"
#include "lib/simulation/run/setup.h"
#include "tools/orthodyn/command_options.h"

namespace orthodyn {

struct SceneArguments {
  std::string scene;
  SceneChanges changes = {};
};

void declare_scene(SceneArguments& arguments, CommandOptions& options);

struct SetupOfAnyTime {
  Setup setup;
  bool has_time;  // false if the time span was assumed
};

// Reads, validates and builds a scene; prints warnings to stderr. If the scene has no `time`, assumes 1 s and prints a
// notice. `uses_time`: whether to check inputs against the time span. Throws ConfigError.
SetupOfAnyTime set_up_without_time(const std::string& scene, const SceneChanges& changes, bool uses_time = true);

}  // namespace orthodyn
