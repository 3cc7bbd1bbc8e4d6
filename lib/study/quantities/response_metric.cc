#include "lib/study/quantities/response_metric.h"

#include <cmath>
#include <complex>

namespace orthodyn::study {

double metric(const HarmonicResponse& response, std::size_t column, ResponseMetric wanted,
              const std::optional<double>& frequency) {
  switch (wanted) {
    case ResponseMetric::amplitude: return std::abs(response.amplitude(column, *frequency));
    case ResponseMetric::phase: return std::arg(response.amplitude(column, *frequency));
    case ResponseMetric::peak: return response.peak(column).amplitude;
    case ResponseMetric::peak_frequency: return response.peak(column).frequency;
  }
  return std::nan("");
}

}  // namespace orthodyn::study
