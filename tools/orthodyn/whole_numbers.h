// Options that are lists of numbers.
#pragma once

#include <string>
#include <vector>

namespace orthodyn {

// Of "2,4,8". Throws ConfigError that names `option` for what is none, or not within [least, most].
std::vector<int> whole_numbers(const std::string& option, const std::string& text, int least, int most);

}  // namespace orthodyn
