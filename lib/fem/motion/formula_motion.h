// A motion by three formulas of the displacement, u(t, X); velocity and acceleration are differences of order
// eight and seven (differences.h), which do not reach across a kink nor to times before the start.
#pragma once

#include <array>

#include "lib/config/formula.h"
#include "lib/fem/differences.h"
#include "lib/fem/motion/motion.h"

namespace orthodyn {

class FormulaMotion : public Motion {
 public:
  // u in m; the kinks and the start in s.
  FormulaMotion(std::array<TimePointFormula, 3> displacement, DifferenceStep step, std::vector<double> kinks,
                double start);

  // Throws ConfigError where a formula has no value.
  Moved at(double t, const NodalVector& X) const override;
  std::vector<double> kinks() const override { return kinks_; }
  bool has_continuous_velocity() const override { return kinks_.empty(); }
  StepLimits step_limits(double start, double end, const NodalVector& X) const override;

 private:
  std::array<TimePointFormula, 3> u_;
  DifferenceStep step_;
  std::vector<double> kinks_, limits_;  // limits: kinks and start
};

// From the motion of two of the points between two times, s.
StepLimits step_limits_of(const std::array<TimePointFormula, 3>& displacement, double start, double end,
                          const std::vector<double>& kinks, const NodalVector& X);

}  // namespace orthodyn
