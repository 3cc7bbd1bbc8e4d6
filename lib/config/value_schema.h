// What may stand at a key, told to other programs: from schema come the words of `orthodyn list`, the
// JSON Schema of the input and the reference page.
#pragma once

#include <functional>
#include <limits>
#include <map>
#include <memory>
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

// One of the things that a section with `type` can be.
struct Alternative {
  std::string sentence;
  std::vector<Key> keys;                                        // beside `type`
  std::vector<std::pair<std::string, std::string>> facts = {};  // ("source", "Newmark 1959"), for lists
};

struct ValueSchema {
  enum class Kind { number, integer, boolean, text, file, word, list, named, section, choice, either, anything };

  Kind kind = Kind::anything;
  std::string words = {};                       // for people, where the kind does not say it all: "formula of x, y, z"
  std::vector<std::string> names = {};          // word: the allowed ones
  bool behind_name = false;                     // word: each of them behind any name and a dot
  std::vector<ValueSchema> items = {};          // list and named: of each; either: the possible ones
  std::size_t count = 0;                        // list: 0 for any
  std::string title = {};                       // section and choice: the C++ type's name, which tells them apart
  std::function<std::vector<Key>()> keys = {};  // section
  std::function<std::map<std::string, Alternative>()> alternatives = {};  // choice
};

// One key of a section.
struct Key {
  std::string name;
  ValueSchema schema;
  std::string unit;  // SI, "" for none
  Range range;       // of a number, and of each number of a list
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
