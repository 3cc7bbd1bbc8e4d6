// Prints without throwing, so that a closed stream does not end the computation, as it would with fmt::print.
#pragma once

#include <cstdio>
#include <string>

namespace orthodyn {

inline void print_nothrow(const std::string& text, std::FILE* out = stderr) noexcept { std::fputs(text.c_str(), out); }

}  // namespace orthodyn
