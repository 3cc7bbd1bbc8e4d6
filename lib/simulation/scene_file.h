// A scene's file with changes to it, before it is validated and built (setup.h).
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "lib/config/config.h"

namespace orthodyn {

struct SceneChanges {
  std::vector<std::string> set = {};                     // "path=value", the value in YAML
  std::optional<std::string> integrator = std::nullopt;  // short for integrator.type=NAME; `set` goes after it
};

// Throws ConfigError for a file that cannot be read, one that is no scene, and a change that does not apply.
Config read_scene_file(const std::string& file, const SceneChanges& changes);

}  // namespace orthodyn
