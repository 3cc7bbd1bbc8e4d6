// The natural modes that metrics request: by number, not counting rigid modes, or by effective mass along an axis.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "lib/analysis/modes.h"
#include "lib/study/quantities/wanted_metric.h"

namespace orthodyn {

struct WantedModes {
  Modes modes;  // all up to the highest requested one
  // By metric: index of its mode in modes.modes; empty if the model has too few modes.
  std::vector<std::optional<std::size_t>> chosen;
};

// Precondition: each metric has `mode` or `along`. Throws what natural_modes() throws.
WantedModes wanted_modes(const std::vector<WantedMetric>& metrics, const Model& model, const State& about);

}  // namespace orthodyn
