// The versions of orthodyn and of its libraries.
#pragma once

#include <map>
#include <string>

namespace orthodyn {

std::string orthodyn_version();

// The commit of the build, with "-dirty" if files differed from it; "unknown" if built outside of a clone.
std::string orthodyn_commit();

// Versions by library, such as {"SUNDIALS", "6.4.1"}. The module that wraps a library adds its entry.
std::map<std::string, std::string>& library_versions();

}  // namespace orthodyn
