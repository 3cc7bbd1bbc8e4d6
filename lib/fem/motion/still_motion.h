// The displacements of another motion with zero velocity and acceleration, as supports have them in static analyses.
#pragma once

#include <memory>

#include "lib/fem/motion/motion.h"

namespace orthodyn {

class StillMotion : public Motion {
 public:
  explicit StillMotion(std::shared_ptr<const Motion> places) : places_(std::move(places)) {}

  Moved at(double t, const NodalVector& X) const override {
    Moved out = places_->at(t, X);
    out.v.setZero();
    out.a.setZero();
    return out;
  }
  std::vector<double> kinks() const override { return {}; }
  bool has_continuous_velocity() const override { return true; }

 private:
  std::shared_ptr<const Motion> places_;
};

}  // namespace orthodyn
