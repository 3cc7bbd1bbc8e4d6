// The versions of orthodyn and of the libraries that it runs on.
#pragma once

#include <map>
#include <string>

namespace orthodyn {

std::string orthodyn_version();

// The commit that this was built from, with "-dirty" where files differed from it; "unknown" outside of a clone.
std::string orthodyn_commit();

// Each module that wraps a library adds its entry: {"SUNDIALS", "6.4.1"}.
std::map<std::string, std::string>& library_versions();

}  // namespace orthodyn
