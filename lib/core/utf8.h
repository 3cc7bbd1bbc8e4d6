// Whether a text is UTF-8 (RFC 3629): input that is not would be refused by those who read our files.
#pragma once

#include <string>
#include <string_view>

namespace orthodyn {

// The index of the first byte that begins no character, or npos.
std::size_t find_invalid_utf8(std::string_view text);

// Of Latin-1 (ISO 8859-1).
std::string utf8_from_latin1(std::string_view text);

}  // namespace orthodyn
