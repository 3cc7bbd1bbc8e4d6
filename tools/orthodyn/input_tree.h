// The input as a tree of sections, walked from the declarations of the keys: what `orthodyn schema` and
// the reference page are written from.
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

// scene, comparison
const std::vector<InputKind>& input_kinds();

// A section of the input, or one of the things that a section with `type` can be.
struct InputSection {
  std::string path;      // "materials.<name>", "clamps.<n>.box"; "" for the file itself
  std::string type;      // the word of `type`, or ""
  std::string sentence;  // of the key that it stands at, or of the type
  std::vector<Key> keys;
  std::vector<std::pair<std::string, std::string>> facts = {};  // of the type: ("source", "Newmark 1959")
};

// All sections of a file, each before those within it; what can stand in several places is listed once.
std::vector<InputSection> input_sections(const InputKind& kind);

// The type that a section with `type` has where it says none, or "".
std::string default_type(const Key& key);

}  // namespace orthodyn
