// Time series of quantities and their metrics. A series has samples at the end of every step, at three or more evenly
// spaced times within it, and at the output times.
#pragma once

#include <memory>
#include <vector>

#include "lib/scene/expectation.h"
#include "lib/scene/quantity.h"
#include "lib/simulation/output/balance.h"

namespace orthodyn {

// One quantity over time. `values` holds `components` values per time.
struct Series {
  int components = 1;
  std::vector<double> times, values;

  std::size_t size() const { return times.size(); }
};

// Metrics of a series; all but drift() need a scalar series. NaN if the series has no such metric.

// Largest value, or the smallest with sign = -1, refined by a parabola through the neighbouring samples; and the time
// (s) of this value.
double maximum(const Series& series, double sign = 1);
double time_of_maximum(const Series& series, double sign = 1);
double mean(const Series& series);       // mean over time
double frequency(const Series& series);  // Hz, from upward crossings of the mean
// Time from the start (s) after which the values differ from the last value by at most `share` of their range; NaN if
// this time is in the last tenth of the time span.
double settling_time(const Series& series, double share);
// Largest change from the start, in the series' unit; the Euclidean norm for vectors.
double drift(const Series& series);
// Largest rise of a scalar above the start, in the series' unit, >= 0.
double gain(const Series& series);
// Time (s) at which the absolute value first reaches `level`, interpolated linearly between samples; NaN if it never
// does.
double onset(const Series& series, double level);

class SeriesRecorder : public Observer {
 public:
  SeriesRecorder(const Model& model, const Integrator& integrator, std::vector<Quantity> quantities);
  void on_start(const ObservedState& observed) override;
  void on_output(const ObservedState& observed) override;
  void on_step(const StepInfo& info, const ObservedState& observed, const Integrator& integrator) override;

  const Series& series(std::size_t quantity) const { return series_[quantity]; }
  // Value of a scalar quantity at the time `t` (s), which must be the start or an output time of the run, up to
  // round-off.
  double at(std::size_t quantity, double t) const;
  // Largest kinetic or elastic energy, J; 0 if no energy balance is recorded.
  double energy_scale() const { return energy_ ? energy_->scale() : 0; }

 private:
  void record(const ObservedState& observed);
  std::vector<double> values(std::size_t quantity, const ObservedState& observed) const;

  const Model& model_;
  std::vector<Quantity> quantities_;
  std::vector<Series> series_;
  std::vector<double> pending_;          // output times within the step
  std::unique_ptr<EnergyMeter> energy_;  // null without an energy balance
  double last_t_ = 0;
};

// The metric named by `wanted`, computed for a recorded quantity; NaN if the series has no such metric.
double metric(const Expectation& wanted, const SeriesRecorder& recorder, std::size_t quantity);

// Output times (s) after `start` that the expectations need, ascending.
std::vector<double> requested_times(const std::vector<Expectation>& wanted, double start);

}  // namespace orthodyn
