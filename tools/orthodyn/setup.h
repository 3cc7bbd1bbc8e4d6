// From the command line's arguments to a model and its integrator.
#pragma once

#include "lib/simulation/setup.h"
#include "tools/orthodyn/scene_options.h"

namespace orthodyn {

// A YAML file with the changes of the command line.
Config read_config(const std::string& file, const std::optional<std::string>& integrator,
                   const std::vector<std::string>& assignments);

// Validates and builds; prints warnings to stderr. Both throw ConfigError.
Setup set_up_and_warn(Config config);
Setup set_up(const SceneArguments& arguments);

}  // namespace orthodyn
