// The sections of the input files, collected from the declared keys for `orthodyn schema` and `list --markdown`.
#pragma once

#include <string>
#include <vector>

#include "lib/config/value_schema.h"

namespace orthodyn {

// One kind of YAML file.
struct InputKind {
  std::string name, sentence;
  std::vector<Key> keys;
};

// scene, comparison, sweep, stability
const std::vector<InputKind>& input_kinds();

// A section of the input. A section with the key `type` gives one InputSection per type.
struct InputSection {
  std::string path;      // "materials.<name>", "clamps.<n>.box"; "" for the file itself
  std::string type;      // value of `type`, or ""
  std::string sentence;  // describes the section, or the type
  std::vector<Key> keys;
  std::vector<std::pair<std::string, std::string>> facts = {};  // name and text: ("source", "Newmark 1959")
};

// All sections of a file, each before its subsections. A section that may occur in several places is listed once.
std::vector<InputSection> input_sections(const InputKind& kind);

// Default type of the section that `key` declares; "" without a default.
std::string default_type(const Key& key);

}  // namespace orthodyn
