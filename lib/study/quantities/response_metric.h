// Metrics of the response in a harmonic analysis.
#pragma once

#include <optional>
#include <string>

#include "lib/scene/expectation.h"
#include "lib/simulation/harmonic/harmonic_response.h"

namespace orthodyn::study {

// A metric of a column's response, in SI units. Precondition: `frequency` (Hz) is given for amplitude and phase.
double metric(const HarmonicResponse& response, std::size_t column, ResponseMetric wanted,
              const std::optional<double>& frequency);

}  // namespace orthodyn::study
