// `orthodyn run` of a static scene.
#pragma once

#include "lib/simulation/result_folder.h"
#include "tools/orthodyn/run_arguments.h"
#include "tools/orthodyn/setup.h"

namespace orthodyn {

// Writes the result into the folder and returns the exit code. `resolved` is the scene with its defaults. Throws
// ConfigError before anything is written.
int run_static(const RunArguments& arguments, const Setup& setup, ResultFolder& folder, const std::string& resolved);

}  // namespace orthodyn
