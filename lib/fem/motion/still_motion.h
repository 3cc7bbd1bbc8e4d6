// The displacements of another motion at one time, with zero velocity and acceleration, as supports have them in static
// analyses: they grow evenly during the second before it (Parts::loads_at in fem_model.h).
#pragma once

#include <algorithm>
#include <memory>

#include "lib/fem/motion/motion.h"

namespace orthodyn {

class StillMotion : public Motion {
 public:
  // s: the time of the displacements.
  StillMotion(std::shared_ptr<const Motion> places, double time) : places_(std::move(places)), time_(time) {}

  Moved at(double t, const NodalVector& X) const override {
    const NodalVector none = NodalVector::Zero(3, X.cols());
    return {places_->part_of_way(std::clamp(t - (time_ - 1), 0.0, 1.0), time_, X), none, none};
  }
  std::vector<double> kinks() const override { return {}; }
  bool has_continuous_velocity() const override { return true; }

 private:
  std::shared_ptr<const Motion> places_;
  double time_;
};

}  // namespace orthodyn
