// Natural frequencies of a point of a sweep: by number, rigid modes not counted, or by effective mass along an axis.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "lib/analysis/modes.h"
#include "lib/study/quantities/wanted_metric.h"

namespace orthodyn {

// Modes, up to the highest that is wanted, and of each metric, which has `mode` or `along`, which of them it is; none
// where the model is too small to have it.
struct WantedModes {
  Modes modes;
  std::vector<std::optional<std::size_t>> chosen;
};

// Throws what natural_modes() throws.
WantedModes wanted_modes(const std::vector<WantedMetric>& metrics, const Model& model, const State& about);

}  // namespace orthodyn
