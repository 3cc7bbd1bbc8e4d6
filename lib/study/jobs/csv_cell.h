// A value as a cell of a CSV file.
#pragma once

#include "lib/study/compare/point_result.h"

namespace orthodyn {

// Texts in quotes where they need them; nothing for null.
inline std::string csv_cell(const Json& value) {
  if (value.is_null()) return "";
  if (!value.is_string()) return value.dump();
  const std::string text = value;
  if (text.find_first_of(",\"\n") == std::string::npos) return text;
  std::string out = "\"";
  for (const char c : text) out += c == '"' ? std::string("\"\"") : std::string(1, c);
  return out + "\"";
}

}  // namespace orthodyn
