// A motion by three formulas of the displacement, u(t, X); velocity and acceleration are differences of order
// eight and seven (differences.h), which do not reach across a kink nor to times before the start.
#pragma once

#include <array>

#include "lib/config/formula.h"
#include "lib/fem/motion/motion.h"

namespace orthodyn {

class FormulaMotion : public Motion {
 public:
  // u in m; the step of the differences, the kinks and the start in s.
  FormulaMotion(std::array<TimePointFormula, 3> displacement, double resolution, std::vector<double> kinks,
                double start);

  // Throws ConfigError where a formula has no value.
  Moved at(double t, const NodalVector& X) const override;
  std::vector<double> kinks() const override { return kinks_; }
  bool has_continuous_velocity() const override { return kinks_.empty(); }
  // From the motion of two of the points.
  StepLimits step_limits(double start, double end, const NodalVector& X) const override;

 private:
  std::array<TimePointFormula, 3> u_;
  double resolution_;
  std::vector<double> kinks_, limits_;  // limits: kinks and start
};

}  // namespace orthodyn
