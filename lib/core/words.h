// Lists of names in messages.
#pragma once

#include <string>
#include <vector>

namespace orthodyn {

// The entry of `names` nearest to `name` by edit distance, or "" if none is near.
std::string nearest_name(const std::string& name, const std::vector<std::string>& names);

// "a, b, c"
std::string join(const std::vector<std::string>& names, const std::string& separator = ", ");

}  // namespace orthodyn
