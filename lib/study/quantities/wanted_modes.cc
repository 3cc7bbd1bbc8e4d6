#include "lib/study/quantities/wanted_modes.h"

#include <algorithm>
#include <cmath>

namespace orthodyn {

namespace {

constexpr int kAlong = 20;  // modes among which that of the largest effective mass is looked for
constexpr int kRigid = 6;   // modes of a free body

// `count` modes that are not zero, or all that there are. How many are zero shows only in those that were computed.
Modes elastic_modes(const Model& model, const State& about, int count) {
  const int all = static_cast<int>(about.q.size());
  int size = std::min(count, all);
  Modes modes = natural_modes(model, about, size);
  while (size < all && size - modes.zeros < count) {
    size = std::min(count + std::max(modes.zeros, kRigid), all);
    modes = natural_modes(model, about, size);
  }
  return modes;
}

std::optional<std::size_t> chosen_by(const WantedMetric& f, const Modes& modes) {
  const auto first = modes.modes.begin() + std::min<std::ptrdiff_t>(modes.zeros, std::ssize(modes.modes));
  const auto number = [&](auto mode) { return static_cast<std::size_t>(mode - modes.modes.begin()); };
  if (f.mode) return modes.modes.end() - first < *f.mode ? std::nullopt : std::optional(number(first + *f.mode - 1));
  const auto last = first + std::min<std::ptrdiff_t>(kAlong, modes.modes.end() - first);
  const auto axis = static_cast<Eigen::Index>(*f.along);
  const auto less = [&](const Mode& a, const Mode& b) { return a.effective_mass()[axis] < b.effective_mass()[axis]; };
  const auto found = std::max_element(first, last, less);
  return found == last ? std::nullopt : std::optional(number(found));
}

}  // namespace

WantedModes wanted_modes(const std::vector<WantedMetric>& metrics, const Model& model, const State& about) {
  int count = 1;
  for (const auto& f : metrics) count = std::max(count, f.along ? kAlong : f.mode.value_or(1));
  WantedModes out{elastic_modes(model, about, count), {}};
  std::size_t highest = 0;
  for (const auto& f : metrics) {
    out.chosen.push_back(chosen_by(f, out.modes));
    if (out.chosen.back()) highest = std::max(highest, *out.chosen.back() + 1);
  }
  out.modes.modes.resize(highest);
  out.modes.zeros = std::min(out.modes.zeros, static_cast<int>(highest));
  return out;
}

}  // namespace orthodyn
