// Records derivatives of named quantities at the start and at the output times of a motion, per SI unit of the
// parameters of Setup::sensitivities.
#pragma once

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "lib/simulation/output/observer.h"
#include "lib/simulation/run/setup.h"

namespace orthodyn::study {

class SlopeRecorder : public Observer {
 public:
  // `setup`: with sensitivities; it must outlive the recorder.
  SlopeRecorder(const Setup& setup, const std::vector<std::string>& quantities)
      : setup_(setup), outputs_(named_quantities(quantities, setup.scene, *setup.built.model)) {}

  void on_start(const ObservedState& observed) override {
    times_.push_back(observed.t());
    for (int i = 0; i < setup_.sensitivities->count(); ++i) record(i, observed, setup_.sensitivities->initial(i));
  }
  void on_output(const ObservedState& observed) override {
    times_.push_back(observed.t());
    for (int i = 0; i < setup_.sensitivities->count(); ++i) {
      State slope;
      setup_.integrator->interpolate_sensitivity(i, observed.t(), slope);
      record(i, observed, slope);
    }
  }

  // Of a quantity at the start or the output time nearest to t, by parameter.
  std::vector<double> at(std::size_t quantity, double t) const {
    const auto nearest = std::min_element(times_.begin(), times_.end(),
                                          [t](double a, double b) { return std::abs(a - t) < std::abs(b - t); });
    const auto count = static_cast<std::size_t>(setup_.sensitivities->count());
    const auto first = static_cast<std::size_t>(nearest - times_.begin()) * count;
    std::vector<double> out;
    for (std::size_t i = 0; i < count; ++i) out.push_back(slopes_[first + i][static_cast<Eigen::Index>(quantity)]);
    return out;
  }

 private:
  void record(int i, const ObservedState& observed, const State& slope) {
    slopes_.push_back(setup_.sensitivities->derivative(i, observed.state(), slope, outputs_));
  }

  const Setup& setup_;
  SceneOutputs outputs_;
  std::vector<double> times_;
  std::vector<Eigen::VectorXd> slopes_;  // all parameters of the first time, then of the second, ...
};

}  // namespace orthodyn::study
