// Shared libraries of users, whose materials, terms, integrators and meshes register themselves.
#pragma once

#include <string>
#include <vector>

namespace orthodyn {

inline constexpr const char* kPluginsVariable = "ORTHODYN_PLUGINS";

// Loads them, and those that the environment variable ORTHODYN_PLUGINS lists (with colons); sets it, so
// that the processes of a comparison load them too. Throws ConfigError.
void load_plugins(const std::vector<std::string>& files);

}  // namespace orthodyn
