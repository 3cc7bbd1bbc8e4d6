// Numbers in text for readers.
#pragma once

#include <fmt/format.h>

#include <string>

#include "lib/core/parse_number.h"

namespace orthodyn {

// A number with four significant digits; any other text as it is.
inline std::string shortened(const std::string& text) {
  double value = 0;
  return parse_number(std::string_view(text), value) ? fmt::format("{:.4g}", value) : text;
}

}  // namespace orthodyn
