// Names of the entries of a study's lists.
#pragma once

#include <algorithm>
#include <filesystem>
#include <string>
#include <vector>

namespace orthodyn {

// The name of a study or a scene without one of its own: its file's, without folder and ending.
inline std::string stem(const std::string& path) { return std::filesystem::path(path).stem().string(); }

// Throws ConfigError at the second of two entries with the same label. An entry has `label` and `origin`.
template <class Entry>
void refuse_equal_labels(const std::vector<Entry>& entries) {
  for (auto a = entries.begin(); a != entries.end(); ++a)
    if (std::any_of(entries.begin(), a, [&](const Entry& b) { return b.label == a->label; }))
      a->origin.fail("'" + a->label + "' occurs twice here; give one of them a different 'label'");
}

}  // namespace orthodyn
