// Names in messages: lists of them, and what may be meant by one that is not known.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace orthodyn {

// "; did you mean 'density'?" with the entry of `known` that is nearest to `found` by edit distance; `otherwise` where
// none is near.
std::string did_you_mean(const std::string& found, const std::vector<std::string>& known,
                         const std::string& otherwise = "");

// So many of `known` that are nearest to `found` by edit distance, the nearest first.
std::vector<std::string> nearest_names(const std::string& found, std::vector<std::string> known, std::size_t count);

// "expected one of a, b, found 'x'", and which of them may be meant.
std::string expected_one_of(const std::vector<std::string>& known, const std::string& found);

// "a, b, c"
std::string join(const std::vector<std::string>& names, const std::string& separator = ", ");

// "1 point", "2 points"; of words that take an s.
std::string counted(long number, const std::string& what);

}  // namespace orthodyn
