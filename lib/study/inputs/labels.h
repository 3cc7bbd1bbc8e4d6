// Labels of the entries in a study's lists.
#pragma once

#include <algorithm>
#include <filesystem>
#include <string>
#include <vector>

namespace orthodyn {

// File name without folder and extension: the default name of a study or scene.
inline std::string stem(const std::string& path) { return std::filesystem::path(path).stem().string(); }

// Throws ConfigError at the second of two entries with the same `label`. Entries have `label` and `origin`.
template <class Entry>
void refuse_equal_labels(const std::vector<Entry>& entries) {
  for (auto a = entries.begin(); a != entries.end(); ++a)
    if (std::any_of(entries.begin(), a, [&](const Entry& b) { return b.label == a->label; }))
      a->origin.fail("'" + a->label + "' is used twice; give one of the two a different 'label'");
}

}  // namespace orthodyn
