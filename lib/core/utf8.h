// Checks text for UTF-8 (RFC 3629), which readers of our output files require, and converts Latin-1 to it.
#pragma once

#include <string>
#include <string_view>

namespace orthodyn {

// The index of the first byte that does not begin a valid character, or npos.
std::size_t find_invalid_utf8(std::string_view text);

// Converts from Latin-1 (ISO 8859-1).
std::string utf8_from_latin1(std::string_view text);

}  // namespace orthodyn
