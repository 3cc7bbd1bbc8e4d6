// The natural modes that metrics request: by number, not counting rigid modes, by effective mass along an axis, or as
// the one that belongs to a measured mode.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "lib/analysis/modes.h"
#include "lib/study/quantities/mode_matching.h"
#include "lib/study/quantities/wanted_metric.h"

namespace orthodyn {

struct WantedModes {
  Modes modes;  // all up to the highest requested one
  // By metric: index of its mode in modes.modes; empty if the model has too few modes, or none belongs to it.
  std::vector<std::optional<std::size_t>> chosen;
  std::vector<std::optional<ModeMatch>> matches;  // by metric; empty without WantedMetric::matching
};

// Preconditions: each metric has `mode` or `along`, and WantedMetric::matching is an index of `matchings`. Throws what
// natural_modes() and natural_modes_below() throw.
WantedModes wanted_modes(const std::vector<WantedMetric>& metrics, const FemModel& model, const State& about,
                         const std::vector<ModeMatching>& matchings = {});

}  // namespace orthodyn
