// Prescribed motion of support points. Displacement, velocity and acceleration are functions of time and rest position.
#pragma once

#include <array>
#include <memory>
#include <vector>

#include "lib/config/formula.h"
#include "lib/fem/differences.h"
#include "lib/fem/dof_map.h"
#include "lib/ode/step_limits.h"

namespace orthodyn {

// Displacements (m), velocities (m/s) and accelerations (m/s^2), one column per point.
struct Moved {
  NodalVector u, v, a;
};

class TimeFunction;

class Motion {
 public:
  virtual ~Motion() = default;
  // Motion at time t (s) of points with rest positions X (m). At a kink, v and a are right-hand derivatives.
  virtual Moved at(double t, const NodalVector& X) const = 0;
  // Displacements (m) after the fraction `share` (0 to 1) of the motion from the rest positions to those at time t.
  virtual NodalVector part_of_way(double share, double t, const NodalVector& X) const { return share * at(t, X).u; }
  virtual std::vector<double> kinks() const = 0;  // times at which the motion is not smooth, s
  virtual bool has_continuous_velocity() const = 0;
  // Step limits between the kinks, from `start` to `end` (s).
  virtual StepLimits step_limits(double /*start*/, double /*end*/, const NodalVector& /*X*/) const { return {}; }
};

// Rigid motion (rigid_motion.cc). `translation` (m) and `angle` (rad) are those at factor 1. The axis goes through
// `point` (m) along the unit vector `axis`.
std::shared_ptr<const Motion> rigid_motion(const Vec3& translation, const Vec3& point, const Vec3& axis, double angle,
                                           std::shared_ptr<const TimeFunction> factor);

// Motion by formulas of the displacement u(t, X) in m (formula_motion.cc). The formulas are not smooth at `kinks` (s)
// and are not evaluated before `start` (s). Motion::at() throws ConfigError if a formula has no value.
std::shared_ptr<const Motion> formula_motion(std::array<TimePointFormula, 3> displacement, DifferenceStep step,
                                             std::vector<double> kinks, double start);

// Step limits of formulas from `start` to `end` (s), for the motion of the first and last of the points X.
StepLimits step_limits_of(const std::array<TimePointFormula, 3>& displacement, double start, double end,
                          const std::vector<double>& kinks, const NodalVector& X);

}  // namespace orthodyn
