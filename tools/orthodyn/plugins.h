// Loads plugins: shared libraries of users that register materials, terms, integrators or meshes.
#pragma once

#include <string>
#include <vector>

namespace orthodyn {

inline constexpr const char* kPluginsVariable = "ORTHODYN_PLUGINS";

// Loads the files listed in the environment variable ORTHODYN_PLUGINS (separated by colons), then `files`. Lists all of
// them in the variable, so that the processes of a study load them too. Throws ConfigError for a file that cannot be
// loaded.
void load_plugins(const std::vector<std::string>& files);

}  // namespace orthodyn
