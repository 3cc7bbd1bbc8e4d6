// Values of the input and of results as JSON, and files of JSON.
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

// Of a file; discarded (no object) if there is none or it is cut short.
Json read_json(const std::filesystem::path& file);

// As text, whatever bytes a file or a crashed program has put in.
std::string to_text(const Json& json, int indent = -1);

// The value of a key; null where the object has none, or is none.
Json member(const Json& object, const std::string& key);

// As a cell of a CSV file: texts in quotes where they need them; nothing for null.
std::string csv_cell(const Json& value);

// JSON has no word for infinite and undefined numbers: they are null, and NaN when they are read.
Json finite_or_null(double x);
double number_or_nan(const Json& json);
Json numbers_json(const std::vector<double>& numbers);
std::vector<double> numbers_from(const Json& json);

// Null for nothing.
template <class T>
Json optional_json(const std::optional<T>& x) {
  return x ? Json(*x) : Json();
}

template <class T>
std::optional<T> optional_from(const Json& json) {
  return json.is_null() ? std::nullopt : std::optional<T>(json.get<T>());
}

// The value that a word of the input stands for. Throws std::invalid_argument for an unknown one.
template <class E>
E from_word(const std::string& word) {
  for (const auto& [value, name] : EnumNames<E>::list)
    if (word == name) return value;
  throw std::invalid_argument("unknown word '" + word + "'");
}

}  // namespace orthodyn
