// A description of the values that a key accepts, for `orthodyn list`, the JSON Schema and the reference page.
#pragma once

#include <functional>
#include <limits>
#include <map>
#include <string>
#include <utility>
#include <vector>

namespace orthodyn {

struct Range {
  double low = -std::numeric_limits<double>::infinity();
  double high = std::numeric_limits<double>::infinity();
  bool low_open = false, high_open = false;

  bool contains(double x) const { return (low_open ? x > low : x >= low) && (high_open ? x < high : x <= high); }
};

struct Key;

// One of the types that the key `type` of a section selects.
struct Alternative {
  std::string sentence;
  std::vector<Key> keys;                                        // without `type`
  std::vector<std::pair<std::string, std::string>> facts = {};  // ("source", "Newmark 1959"), for lists
};

struct ValueSchema {
  enum class Kind { number, integer, boolean, text, file, word, list, named, section, choice, either, anything };

  Kind kind = Kind::anything;
  std::string words = {};               // description for people where `kind` says too little: "formula of x, y, z"
  std::vector<std::string> names = {};  // word: allowed words
  bool behind_name = false;             // word: also allowed as "NAME.word" with any NAME
  std::vector<ValueSchema> items = {};  // list and named: schema of each item; either: the alternatives
  std::size_t count = 0;                // list: required length, 0 for any
  std::string title = {};               // section and choice: name of the C++ type, as an identifier
  std::function<std::vector<Key>()> keys = {};                            // section
  std::function<std::map<std::string, Alternative>()> alternatives = {};  // choice
};

// One key of a section.
struct Key {
  std::string name;
  ValueSchema schema;
  std::string unit;  // SI, "" for none
  Range range;       // allowed values of a number, or of each number in a list
  std::string fallback, sentence;
  bool required = false;
};

// "> 0", ">= 0", "in (-1, 0.5)", or "" for any number.
std::string range_text(const Range& range);

// "list of 3 numbers", "five|six", "section with type"
std::string type_text(const ValueSchema& schema);

// A type's name without namespaces.
std::string type_title(const char* mangled);

}  // namespace orthodyn
