// The options of commands that take one scene.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "tools/orthodyn/command_options.h"

namespace orthodyn {

struct SceneArguments {
  std::string scene;
  std::vector<std::string> set;  // "path=value"
  std::optional<std::string> integrator;
};

void declare_scene(SceneArguments& arguments, CommandOptions& options);

}  // namespace orthodyn
