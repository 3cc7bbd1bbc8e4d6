// A scene with changes, and with an integrator that a study chooses.
#pragma once

#include <functional>
#include <string>

#include "lib/study/inputs/assignments.h"

namespace orthodyn {

// A scene with its physics fixed.
struct SceneVariant {
  std::string file, text;  // read once: a scene that is edited meanwhile is another one
  Assignments set;
};

// The scene with an integrator of these options, not read yet: of the scene's own options those that `kept` names stay
// where the integrator has such keys. Throws ConfigError.
Config with_integrator(const SceneVariant& variant, const std::string& integrator, const Assignments& options,
                       const std::function<bool(const std::string&)>& kept);

}  // namespace orthodyn
