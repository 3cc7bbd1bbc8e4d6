// Metrics of the response in a harmonic analysis.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "lib/scene/expectation.h"
#include "lib/simulation/harmonic/harmonic_response.h"
#include "lib/simulation/sensitivity/response_sensitivity.h"

namespace orthodyn::study {

// A metric of a column's response, in SI units. Precondition: `frequency` (Hz) is given for amplitude and phase.
double metric(const HarmonicResponse& response, std::size_t column, ResponseMetric wanted,
              const std::optional<double>& frequency);

// Whether metric_slopes() computes derivatives: of amplitude, phase and peak of a motion, not of a peak's frequency.
bool has_slopes(const ResponseColumn& column, ResponseMetric wanted);

// The derivatives of a metric with respect to the parameters of `sensitivity`, in SI units. The frequency
// of a peak is kept: its change does not change the height to first order. Preconditions: has_slopes(), and
// `sensitivity` has the column.
std::vector<double> metric_slopes(const HarmonicResponse& response, const ResponseSensitivity& sensitivity,
                                  std::size_t column, ResponseMetric wanted, const std::optional<double>& frequency);

}  // namespace orthodyn::study
