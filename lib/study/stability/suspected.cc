// Expectations that all integrators miss by the same amount.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <utility>

#include "lib/study/jobs/json_values.h"
#include "lib/study/stability/stability_matrix.h"

namespace orthodyn::study::stability {

namespace {

using Field = std::pair<std::string, std::string>;  // case, variant

std::map<Field, std::vector<Json>> completed_trials(const Json& cases, const Json& trials) {
  std::map<Field, std::vector<Json>> found;
  for (const auto& trial : trials)
    if (member(trial, "status") == "completed") found[{trial.at("case"), trial.at("variant")}].push_back(trial);
  for (const auto& hard : cases) {
    const auto label = hard.at("label").get<std::string>();
    if (hard.at("model") != "") std::erase_if(found, [&](const auto& entry) { return entry.first.first == label; });
  }
  return found;
}

std::optional<Suspicion> suspicion(const Field& field, const std::vector<Json>& trials) {
  if (trials.size() < 2) return {};
  const Json& first = trials.front().at("worst");
  Suspicion s{field.first, field.second, first.at("title"), trials.size(), INFINITY, -INFINITY, first.at("expected")};
  for (const auto& trial : trials) {
    const Json& worst = trial.at("worst");
    if (trial.at("grade") == "pass" || worst.at("title") != s.metric || worst.at("computed").is_null()) return {};
    s.lowest = std::min(s.lowest, worst.at("computed").get<double>());
    s.highest = std::max(s.highest, worst.at("computed").get<double>());
  }
  if (s.highest - s.lowest > first.at("limit").get<double>()) return {};
  return s;
}

}  // namespace

std::string describe(const Suspicion& s) {
  return fmt::format(
      "{}, {}: all {} integrators that completed agree on {} ({:.4g} to {:.4g}) and miss the expected {:.4g}; check "
      "the expectation or the model rather than the integrators",
      s.hard_case, s.variant, s.integrators, s.metric, s.lowest, s.highest, s.expected);
}

std::vector<Suspicion> suspected_expectations(const Json& cases, const Json& trials) {
  std::vector<Suspicion> all;
  for (const auto& [field, completed] : completed_trials(cases, trials))
    if (const auto found = suspicion(field, completed)) all.push_back(*found);
  return all;
}

}  // namespace orthodyn::study::stability
