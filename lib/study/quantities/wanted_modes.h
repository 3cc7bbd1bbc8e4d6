// Natural frequencies of a point of a sweep: by number, rigid modes not counted, or by effective mass along an axis.
#pragma once

#include <vector>

#include "lib/analysis/modes.h"
#include "lib/study/quantities/wanted_figure.h"

namespace orthodyn {

// The frequency of each figure, which has `mode` or `along`, in Hz; NaN for a mode that the model is too small to have.
// Throws what natural_modes() throws.
std::vector<double> wanted_frequencies(const std::vector<WantedFigure>& figures, const Model& model,
                                       const State& about);

}  // namespace orthodyn
