// The options of commands that take one scene, and the scene that they name.
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

// Reads, validates and builds; prints warnings to stderr. Throws ConfigError.
Setup set_up_and_warn(const std::string& scene, const SceneChanges& changes);

// The same for what needs no `time`: a second is taken where the scene does not say, with a notice. Modes have no use
// for it (`uses_time`).
struct SetupOfAnyTime {
  Setup setup;
  bool has_time;
};
SetupOfAnyTime set_up_without_time(const std::string& scene, const SceneChanges& changes, bool uses_time = true);

}  // namespace orthodyn
