// Quantities over time, sampled at every step and three times within it.
#pragma once

#include <memory>
#include <vector>

#include "lib/scene/quantity.h"
#include "lib/simulation/output/balance.h"

namespace orthodyn {

// One quantity's course: values are `components` apart, fastest.
struct Series {
  int components = 1;
  std::vector<double> times, values;

  std::size_t size() const { return times.size(); }
};

// Metrics of a scalar series; NaN where it has none.
double maximum(const Series& series, double sign = 1);  // of sign * value, refined by a parabola
double time_of_maximum(const Series& series, double sign = 1);
double mean(const Series& series);       // over time
double frequency(const Series& series);  // from upward crossings of the mean, 1/s
// The time from the start after which the values stay within `share` of their range about the last one; NaN if
// that is in the last tenth of the time.
double settling_time(const Series& series, double share);
// The largest change from the start, of vectors in the Euclidean norm.
double drift(const Series& series);
// Of scalars. The largest rise above the start, in the series' unit, at least 0.
double gain(const Series& series);
// The time when the size first passes a level, s, linear between samples; NaN if it never does.
double onset(const Series& series, double level);

class SeriesRecorder : public Observer {
 public:
  SeriesRecorder(const Model& model, const Integrator& integrator, std::vector<Quantity> quantities);
  void on_start(const ObservedState& observed) override;
  void on_output(const ObservedState& observed) override;
  void on_step(const StepInfo& info, const ObservedState& observed, const Integrator& integrator) override;

  const Series& series(std::size_t quantity) const { return series_[quantity]; }
  // A scalar quantity at the start or at an output time of the run, but for round-off in the time.
  double at(std::size_t quantity, double t) const;
  // The largest kinetic or elastic energy, J, if an energy balance is among the quantities.
  double energy_scale() const { return energy_ ? energy_->scale() : 0; }

 private:
  void record(const ObservedState& observed);
  std::vector<double> values(std::size_t quantity, const ObservedState& observed) const;

  const Model& model_;
  std::vector<Quantity> quantities_;
  std::vector<Series> series_;
  std::vector<double> pending_;          // output times within the step
  std::unique_ptr<EnergyMeter> energy_;  // only if asked for
  double last_t_ = 0;
};

}  // namespace orthodyn
