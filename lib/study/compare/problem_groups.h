// The problems of a comparison, grouped by common references, and their ids and labels.
#pragma once

#include <set>
#include <string>
#include <vector>

#include "lib/study/compare/comparison_design.h"

namespace orthodyn::study::compare {

// Changes of a scene, and the text that they add to its label: ", cells [45, 9, 9]".
struct Variant {
  Assignments set;
  std::string words;
};

// Sets `groups` and `problems` of a design, with a problem for each scene and variant. Throws ConfigError for a scene
// that cannot be read, or that has no probes although the reference has its own mesh.
void add_problems(const Comparison& comparison, const std::vector<Variant>& variants, Design& design);

// "mesh.cells" -> "cells"
std::string last_key(const std::string& path);

// The label text of one changed key: ", cells [45, 9, 9]".
std::string words_of(const std::string& path, const YamlText& value);

// The label with every run of characters other than letters, digits, '_' and '.' replaced by one '-', and without '-'
// at its ends; "unnamed" if nothing is left.
std::string identifier(const std::string& label);

// Sets unique ids, made from the labels. Equal ids are numbered: "a", "a-2".
template <class Item>
void identify(std::vector<Item>& items) {
  std::set<std::string> taken;
  for (auto& item : items) {
    const std::string id = identifier(item.label);
    item.id = id;
    for (int n = 2; !taken.insert(item.id).second; ++n) item.id = id + "-" + std::to_string(n);
  }
}

}  // namespace orthodyn::study::compare
