// Parses a whole word as a number.
#pragma once

#include <charconv>
#include <string_view>
#include <system_error>

namespace orthodyn {

// False if the word is not a number or is out of range. A leading plus sign, which from_chars refuses, is allowed.
template <class Number>
bool parse_number(std::string_view word, Number& value) {
  if (word.size() > 1 && word[0] == '+' && word[1] != '-') word.remove_prefix(1);
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  return error == std::errc() && end == word.data() + word.size();
}

}  // namespace orthodyn
