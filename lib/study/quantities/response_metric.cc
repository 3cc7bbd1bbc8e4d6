#include "lib/study/quantities/response_metric.h"

#include <cmath>
#include <complex>

namespace orthodyn::study {

namespace {

// The frequency of a column's peak, by a parabola through three amplitudes: beside a sharp peak the derivative of the
// amplitude depends strongly on the frequency. A peak at an end of the range stays there.
double exact_peak_frequency(const HarmonicResponse& response, std::size_t column) {
  constexpr double kStep = 1e-5;  // relative to the frequency
  const double f = response.peak(column).frequency, h = kStep * f;
  const auto amplitude = [&](double at) { return std::abs(response.amplitude(column, at)); };
  const double before = amplitude(f - h), here = amplitude(f), after = amplitude(f + h);
  const double curvature = before - 2 * here + after, offset = (before - after) / (2 * curvature);
  return curvature < 0 && std::abs(offset) <= 1 ? f + offset * h : f;
}

}  // namespace

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

bool has_slopes(const ResponseColumn& column, ResponseMetric wanted) {
  return has_sensitivity(column) && wanted != ResponseMetric::peak_frequency;
}

std::vector<double> metric_slopes(const HarmonicResponse& response, const ResponseSensitivity& sensitivity,
                                  std::size_t column, ResponseMetric wanted, const std::optional<double>& frequency) {
  const double at = wanted == ResponseMetric::peak ? exact_peak_frequency(response, column) : *frequency;
  const std::complex<double> amplitude = response.amplitude(column, at);
  std::vector<double> out;
  for (const std::complex<double>& slope : sensitivity.derivatives(column, at))
    out.push_back(wanted == ResponseMetric::phase ? phase_slope(amplitude, slope) : amplitude_slope(amplitude, slope));
  return out;
}

}  // namespace orthodyn::study
