// How the points of a support move: displacement, velocity and acceleration as functions of time and of the place
// at rest.
#pragma once

#include <vector>

#include "lib/fem/dof_map.h"
#include "lib/ode/step_limits.h"

namespace orthodyn {

// A column per point; m, m/s, m/s^2.
struct Moved {
  NodalVector u, v, a;
};

class Motion {
 public:
  virtual ~Motion() = default;
  // Of the points that are at X at rest. Velocity and acceleration are those from the right at a kink.
  virtual Moved at(double t, const NodalVector& X) const = 0;
  // Displacements on the way to those of a time: u at share 1, none at 0; m.
  virtual NodalVector part_of_way(double share, double t, const NodalVector& X) const { return share * at(t, X).u; }
  virtual std::vector<double> kinks() const = 0;  // where it is not smooth
  virtual bool has_continuous_velocity() const = 0;
  // What it does between the kinks, s.
  virtual StepLimits step_limits(double /*start*/, double /*end*/, const NodalVector& /*X*/) const { return {}; }
};

}  // namespace orthodyn
