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

// A section of the input, or one type of a section with `type`.
struct InputSection {
  std::string path;      // "materials.<name>", "clamps.<n>.box"; "" for the file itself
  std::string type;      // value of `type`, or ""
  std::string sentence;  // describes the key of the section, or the type
  std::vector<Key> keys;
  std::vector<std::pair<std::string, std::string>> facts = {};  // of the type: ("source", "Newmark 1959")
};

// All sections of a file, each before its subsections. A section that may occur in several places is listed once.
std::vector<InputSection> input_sections(const InputKind& kind);

// Default of `type` in the section at `key`; "" without a default.
std::string default_type(const Key& key);

}  // namespace orthodyn
