#include "lib/core/spelling.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <numeric>
#include <optional>
#include <utility>

namespace orthodyn {

namespace {

// Number of insertions, deletions, substitutions and swaps of neighbouring letters that turn a into b (optimal string
// alignment distance): 1 from g31 to g13, 2 from g31 to nu31.
std::size_t edit_distance(const std::string& a, const std::string& b) {
  std::vector<std::size_t> before, above, row(b.size() + 1);
  std::iota(row.begin(), row.end(), 0u);
  for (std::size_t i = 1; i <= a.size(); ++i) {
    before = std::exchange(above, row);
    row[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const bool is_swapped = i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1];
      row[j] = std::min({above[j] + 1, row[j - 1] + 1, above[j - 1] + (a[i - 1] != b[j - 1])});
      if (is_swapped) row[j] = std::min(row[j], before[j - 2] + 1);
    }
  }
  return row.back();
}

// The first of the nearest names. If more than a third of the letters (at least 2) differ in all, the first name that
// begins with this one; otherwise none.
std::optional<std::string> nearest(const std::string& name, const std::vector<std::string>& known) {
  std::optional<std::string> best;
  std::size_t best_distance = std::max<std::size_t>(2, name.size() / 3) + 1;
  for (const auto& other : known)
    if (const auto d = edit_distance(name, other); d < best_distance) best_distance = d, best = other;
  if (best || name.size() < 3) return best;
  const auto longer = std::find_if(known.begin(), known.end(), [&](const auto& o) { return o.starts_with(name); });
  return longer == known.end() ? best : *longer;
}

}  // namespace

std::string did_you_mean(const std::string& found, const std::vector<std::string>& known,
                         const std::string& otherwise) {
  const auto name = nearest(found, known);
  return name && !name->empty() ? "; did you mean '" + *name + "'?" : otherwise;
}

std::vector<std::string> nearest_names(const std::string& found, std::vector<std::string> known, std::size_t count) {
  std::vector<std::pair<std::size_t, std::string>> by_distance;
  for (std::string& name : known) by_distance.emplace_back(edit_distance(found, name), std::move(name));
  std::stable_sort(by_distance.begin(), by_distance.end(),
                   [](const auto& a, const auto& b) { return a.first < b.first; });
  std::vector<std::string> names;
  for (auto& [distance, name] : by_distance)
    if (names.size() < count) names.push_back(std::move(name));
  return names;
}

std::string expected_one_of(const std::vector<std::string>& known, const std::string& found) {
  return "expected one of " + join(known) + ", found '" + found + "'" + did_you_mean(found, known);
}

std::string join(const std::vector<std::string>& names, const std::string& separator) {
  return fmt::format("{}", fmt::join(names, separator));
}

std::string counted(long number, const std::string& what) {
  return fmt::format("{} {}{}", number, what, number == 1 ? "" : "s");
}

}  // namespace orthodyn
