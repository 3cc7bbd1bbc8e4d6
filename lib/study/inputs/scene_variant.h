// A scene with changes, and the scene that results when a study chooses the integrator.
#pragma once

#include <functional>
#include <string>

#include "lib/study/inputs/assignments.h"

namespace orthodyn {

struct SceneVariant {
  std::string file, text;  // path and content; the file is read once, so later edits have no effect
  Assignments set;
};

// The scene with the given integrator and options. Options of the scene's own integrator stay if `kept` accepts them
// and the new integrator has the key. Throws ConfigError; the scene itself is not validated.
Config with_integrator(const SceneVariant& variant, const std::string& integrator, const Assignments& options,
                       const std::function<bool(const std::string&)>& kept);

}  // namespace orthodyn
