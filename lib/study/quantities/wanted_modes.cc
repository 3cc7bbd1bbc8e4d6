#include "lib/study/quantities/wanted_modes.h"

#include <algorithm>
#include <cmath>

#include "lib/fem/fem_model.h"

namespace orthodyn {

namespace {

constexpr int kSearchedModes = 20;  // number of modes among which `along` chooses
constexpr int kRigidModes = 6;      // of a free body

// The rigid modes and the lowest `count` elastic modes, or all modes of a small model. Solves again if there are more
// rigid modes than expected, because their number is known only after a solution.
Modes elastic_modes(const Model& model, const State& about, int count) {
  const int all = static_cast<int>(about.q.size());
  int size = std::min(count, all);
  Modes modes = natural_modes(model, about, size);
  while (size < all && size - modes.zeros < count) {
    size = std::min(count + std::max(modes.zeros, kRigidModes), all);
    modes = natural_modes(model, about, size);
  }
  return modes;
}

std::optional<std::size_t> index_of(const WantedMetric& m, const Modes& modes) {
  const auto first = modes.modes.begin() + std::min<std::ptrdiff_t>(modes.zeros, std::ssize(modes.modes));
  const auto number = [&](auto mode) { return static_cast<std::size_t>(mode - modes.modes.begin()); };
  if (m.mode) return modes.modes.end() - first < *m.mode ? std::nullopt : std::optional(number(first + *m.mode - 1));
  const auto last = first + std::min<std::ptrdiff_t>(kSearchedModes, modes.modes.end() - first);
  const auto axis = static_cast<Eigen::Index>(*m.along);
  const auto less = [&](const Mode& a, const Mode& b) { return a.effective_mass()[axis] < b.effective_mass()[axis]; };
  const auto found = std::max_element(first, last, less);
  return found == last ? std::nullopt : std::optional(number(found));
}

// As many modes as the metrics and the matchings need.
Modes needed_modes(const std::vector<WantedMetric>& metrics, const FemModel& model, const State& about,
                   const std::vector<ModeMatching>& matchings) {
  int count = 1;
  double frequency = 0;
  for (const auto& m : metrics)
    if (!m.matching) count = std::max(count, m.along ? kSearchedModes : m.mode.value_or(1));
  for (const ModeMatching& matching : matchings) {
    if (matching.is_by_shape()) count = std::max(count, matching.searched());
    else frequency = std::max(frequency, matching.highest());
  }
  Modes modes = elastic_modes(model, about, count);
  const bool has_all = std::ssize(modes.modes) == about.q.size();
  return has_all || modes.modes.back().frequency() > frequency ? modes : natural_modes_below(model, about, frequency);
}

}  // namespace

WantedModes wanted_modes(const std::vector<WantedMetric>& metrics, const FemModel& model, const State& about,
                         const std::vector<ModeMatching>& matchings) {
  WantedModes out{needed_modes(metrics, model, about, matchings), {}, {}};
  std::vector<std::vector<ModeMatch>> matches;
  for (const ModeMatching& matching : matchings) matches.push_back(match_modes(matching, out.modes, model, about));
  const auto zeros = static_cast<std::size_t>(out.modes.zeros);
  std::size_t highest = 0;
  for (const auto& m : metrics) {
    auto& match = out.matches.emplace_back();
    if (m.matching) match = matches.at(static_cast<std::size_t>(*m.matching)).at(static_cast<std::size_t>(*m.mode - 1));
    if (!match) out.chosen.push_back(index_of(m, out.modes));
    else if (match->mode == 0) out.chosen.push_back(std::nullopt);
    else out.chosen.push_back(zeros + static_cast<std::size_t>(match->mode) - 1);
    if (out.chosen.back()) highest = std::max(highest, *out.chosen.back() + 1);
  }
  out.modes.modes.resize(highest);
  out.modes.zeros = std::min(out.modes.zeros, static_cast<int>(highest));
  return out;
}

}  // namespace orthodyn
