// The names and paths of a sweep: each must do something, mean one thing in formulas and head one column.
#pragma once

#include "lib/study/sweep/sweep.h"

namespace orthodyn {

// What a scene has without a dot.
std::vector<std::string> scene_keys();

// "; did you mean 'gravity'?", or "".
std::string scene_key_near(const std::string& name);

// Throws ConfigError, with both places where two things clash.
void check_names(const Sweep& sweep);

}  // namespace orthodyn
