#include "lib/study/fit/mode_sentences.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "lib/core/spelling.h"

namespace orthodyn::study::fit {

namespace {

constexpr double kSmallMac = 0.5, kNearlyEqual = 0.1;

bool is_by_order(const Datum& datum) { return datum.metric.mode && !datum.metric.matching; }

// Calls `say` with each measured experiment and the index of its first datum.
template <class Say>
void for_each_measured(const Problem& problem, const Say& say) {
  std::size_t first = 0;
  for (const PreparedExperiment& experiment : problem.experiments()) {
    if (experiment.is_candidate) continue;
    say(experiment, first);
    first += experiment.data.size();
  }
}

std::string mac_text(double mac) { return std::isfinite(mac) ? fmt::format(" (MAC {:.2f})", mac) : std::string(); }

void add_close_modes(const PreparedExperiment& experiment, std::size_t first, const Evaluation& at,
                     std::vector<std::string>& out) {
  for (std::size_t i = 0; i + 1 < experiment.data.size(); ++i) {
    const Datum &lower = experiment.data[i], &upper = experiment.data[i + 1];
    if (!is_by_order(lower) || !is_by_order(upper) || *upper.metric.mode != *lower.metric.mode + 1) continue;
    const double gap = at.computed[first + i + 1] - at.computed[first + i];
    if (gap > lower.deviation + upper.deviation) continue;
    out.push_back(fmt::format(
        "{}: the computed frequencies of modes {} and {} differ by less than their deviations. Modes are matched by "
        "their order, so the search can end at a crossing of two modes: give measured 'shapes', or try another start "
        "or starts: 10",
        experiment.name, *lower.metric.mode, *upper.metric.mode));
  }
}

void add_doubt(const PreparedExperiment& experiment, const Datum& datum, const ModeMatch& match,
               std::vector<std::string>& out) {
  if (!std::isfinite(match.mac)) return;
  const std::string measured =
      fmt::format("{}: measured frequency {} ({:.6g} Hz)", experiment.name, *datum.metric.mode, datum.value);
  if (match.mac < kSmallMac)
    out.push_back(
        fmt::format("{} belongs to computed mode {} with a MAC of only {:.2f}: the points, the direction or the "
                    "columns of the shapes are wrong, or the scene has no such mode",
                    measured, match.mode, match.mac));
  else if (match.next_mac > match.mac - kNearlyEqual)
    out.push_back(
        fmt::format("{} is similar to computed mode {}{} and to mode {}{}: measure shapes at more points, or leave "
                    "this frequency out",
                    measured, match.mode, mac_text(match.mac), match.next, mac_text(match.next_mac)));
}

}  // namespace

bool has_modes_by_order(const Problem& problem) {
  return std::ranges::any_of(problem.data(), [](const Datum* datum) { return is_by_order(*datum); });
}

std::vector<std::string> matched_modes(const Problem& problem, const Search& search) {
  std::vector<std::string> out;
  for_each_measured(problem, [&](const PreparedExperiment& experiment, std::size_t first) {
    std::vector<std::string> others, changes;
    for (std::size_t i = 0; i < experiment.data.size(); ++i) {
      const auto &match = search.at.matches[first + i], &before = search.matches_at_start[first + i];
      if (!match) continue;
      const int number = *experiment.data[i].metric.mode;
      if (match->mode != number)
        others.push_back(fmt::format("{} is computed mode {}{}", number, match->mode, mac_text(match->mac)));
      if (before && before->mode != match->mode)
        changes.push_back(fmt::format("{} from computed mode {} to {}", number, before->mode, match->mode));
    }
    if (!others.empty()) out.push_back(fmt::format("{}: measured frequency {}.", experiment.name, join(others)));
    if (!changes.empty())
      out.push_back(fmt::format("{}: the search moved measured frequency {}.", experiment.name, join(changes)));
  });
  return out;
}

std::vector<std::string> doubtful_modes(const Problem& problem, const Evaluation& at) {
  std::vector<std::string> out;
  for_each_measured(problem, [&](const PreparedExperiment& experiment, std::size_t first) {
    add_close_modes(experiment, first, at, out);
    for (std::size_t i = 0; i < experiment.data.size(); ++i)
      if (const auto& match = at.matches[first + i]) add_doubt(experiment, experiment.data[i], *match, out);
  });
  return out;
}

}  // namespace orthodyn::study::fit
