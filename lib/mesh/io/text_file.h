// The content of a file as one string.
#pragma once

#include <string>

namespace orthodyn {

// Throws ConfigError for a file that is missing, unreadable, or not a regular file (a pipe might
// never end).
std::string read_text_file(const std::string& path);

}  // namespace orthodyn
