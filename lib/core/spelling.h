// Lists of names and spelling suggestions for messages.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace orthodyn {

// "; did you mean 'density'?" with the entry of `known` nearest to `found`; `otherwise` if none is near.
std::string did_you_mean(const std::string& found, const std::vector<std::string>& known,
                         const std::string& otherwise = "");

// The `count` entries of `known` nearest to `found` by edit distance, nearest first.
std::vector<std::string> nearest_names(const std::string& found, std::vector<std::string> known, std::size_t count);

// "expected one of a, b, found 'x'", with a suggestion if one is near.
std::string expected_one_of(const std::vector<std::string>& known, const std::string& found);

// "a, b, c"
std::string join(const std::vector<std::string>& names, const std::string& separator = ", ");

// "1 point", "2 points". The plural must be formed with an s.
std::string counted(long number, const std::string& what);

}  // namespace orthodyn
