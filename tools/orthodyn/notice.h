// Text for whoever looks on. That nobody can read it is no reason to end a computation: unlike fmt::print this never
// throws.
#pragma once

#include <cstdio>
#include <string>

namespace orthodyn {

inline void print_notice(const std::string& text, std::FILE* out = stderr) noexcept { std::fputs(text.c_str(), out); }

}  // namespace orthodyn
