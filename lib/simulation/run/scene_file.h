// A scene's file with changes to it, before it is validated and built (setup.h).
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "lib/config/config.h"

namespace orthodyn {

struct SceneChanges {
  std::vector<std::string> set = {};  // "path=value", the value in YAML
  // Another integrator: of the scene's keys those that it has, too, are kept. `set` goes after it.
  std::optional<std::string> integrator = std::nullopt;
};

// `left_out`: filled with the keys of the scene's integrator that the one named in the changes does not have. Throws
// ConfigError for a file that cannot be read, one that is no scene, and a change that does not apply.
Config read_scene_file(const std::string& file, const SceneChanges& changes,
                       std::vector<std::string>* left_out = nullptr);

// The same of a scene that was read before.
Config changed_scene(Config scene, const SceneChanges& changes, std::vector<std::string>* left_out = nullptr);

// "integrator.max_order has no meaning for newmark and is left out"; "" where nothing is.
std::string left_out_sentence(const std::vector<std::string>& left_out, const SceneChanges& changes);

}  // namespace orthodyn
