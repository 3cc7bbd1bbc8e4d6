#include "lib/study/compare/identifiers.h"

#include <cctype>

namespace orthodyn::study::compare {

std::string last_step(const std::string& path) {
  const auto dot = path.rfind('.');
  return dot == std::string::npos ? path : path.substr(dot + 1);
}

std::string words_of(const std::string& path, const YamlText& value) {
  return ", " + last_step(path) + " " + value.text;
}

std::string identifier(const std::string& label) {
  std::string id;
  for (const char c : label) {
    if (std::isalnum(static_cast<unsigned char>(c)) || c == '_' || c == '.') id += c;
    else if (!id.empty() && id.back() != '-') id += '-';
  }
  while (id.ends_with('-')) id.pop_back();
  return id.empty() ? "unnamed" : id;
}

}  // namespace orthodyn::study::compare
