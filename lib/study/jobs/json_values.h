// Conversions of C++ values to JSON and back, and of JSON to text and CSV.
#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "lib/config/values.h"
#include "lib/simulation/output/json.h"

namespace orthodyn {

// Content of a file; is_discarded() if the file is missing or is not valid JSON.
Json read_json(const std::filesystem::path& file);

// JSON as text with a line break at its end. Invalid UTF-8 is replaced, so that any content can be written. `indent`:
// spaces per level; negative for a single line.
std::string to_text(const Json& json, int indent = -1);

// The value of a key; null if `object` has no such key or is not an object.
Json member(const Json& object, const std::string& key);

// CSV cell: text is quoted where necessary, null is empty.
std::string csv_cell(const Json& value);

// "deflection [m]"; the name alone without a unit.
std::string csv_heading(const std::string& name, const std::string& unit);

// JSON has neither infinity nor NaN: both are written as null. Anything but a number is read as NaN.
Json finite_or_null(double x);
double number_or_nan(const Json& json);

// The value, or null if `x` is empty.
template <class T>
Json optional_json(const std::optional<T>& x) {
  return x ? Json(*x) : Json();
}

// The enum value with the name `word`. Throws std::invalid_argument for an unknown name.
template <class E>
E from_word(const std::string& word) {
  for (const auto& [value, name] : EnumNames<E>::list)
    if (word == name) return value;
  throw std::invalid_argument("unknown word '" + word + "'");
}

}  // namespace orthodyn
