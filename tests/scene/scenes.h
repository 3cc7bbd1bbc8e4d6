// A small valid scene to start from, and ways to break it.
#pragma once

#include <gtest/gtest.h>

#include <string>

#include "lib/scene/build.h"

namespace orthodyn {

inline const std::string kValidScene = R"(mesh: {type: box, size: [2, 1, 1], cells: [2, 1, 1], order: 1}
materials:
  soft: {type: isotropic, density: 1000, young: 1e6, nu: 0.3}
clamps:
  - surface: x0
time: {end: 0.1}
)";

BuiltScene build_text(const std::string& yaml);

// The message of the ConfigError that building this scene throws.
std::string refusal(const std::string& yaml);

std::string replaced(std::string text, const std::string& from, const std::string& to);

}  // namespace orthodyn
