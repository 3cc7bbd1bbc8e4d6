#include "lib/study/quantities/metric.h"

#include <cmath>
#include <set>

namespace orthodyn {

namespace {

// What a change is relative to.
double reference_size(const Expectation& e, const SeriesRecorder& recorder, std::size_t q) {
  const Series& series = recorder.series(q);
  double scale = e.of.value_or(0);
  if (!e.of && e.quantity == kEnergyBalance) scale = recorder.energy_scale();
  if (!e.of && e.quantity != kEnergyBalance)
    for (int c = 0; c < series.components; ++c) scale = std::hypot(scale, series.values[static_cast<std::size_t>(c)]);
  return scale;  // NaN or 0 if there is none: then the metric is not met
}

}  // namespace

double metric(const Expectation& e, const SeriesRecorder& recorder, std::size_t q) {
  const Series& series = recorder.series(q);
  if (e.at) return recorder.at(q, *e.at);
  switch (e.take) {
    case Take::end: return series.values.back();
    case Take::max: return maximum(series);
    case Take::min: return maximum(series, -1);
    case Take::time_of_max: return time_of_maximum(series);
    case Take::time_of_min: return time_of_maximum(series, -1);
    case Take::mean: return mean(series);
    case Take::frequency: return frequency(series);
    case Take::drift: return drift(series) / reference_size(e, recorder, q);
    case Take::gain: return gain(series) / reference_size(e, recorder, q);
    case Take::onset: return e.of ? onset(series, *e.of) : std::nan("");
  }
  return 0;
}

std::vector<double> times_asked_for(const std::vector<Expectation>& expectations, double start) {
  std::set<double> times;
  for (const auto& e : expectations)
    if (e.at && *e.at > start) times.insert(*e.at);
  return {times.begin(), times.end()};
}

}  // namespace orthodyn
