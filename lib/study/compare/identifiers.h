// Names for problems, groups and methods: ids from their labels, and words for what was changed.
#pragma once

#include <set>
#include <string>
#include <vector>

#include "lib/study/inputs/assignments.h"

namespace orthodyn::study::compare {

// "mesh.cells" -> "cells": enough to tell labels apart.
std::string last_step(const std::string& path);

// ", cells [45, 9, 9]"
std::string words_of(const std::string& path, const YamlText& value);

// Letters, digits, '_', '.' and '-' of a label.
std::string identifier(const std::string& label);

// Sets the ids of labelled items, counting those that would be equal.
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
