// Derivatives of outputs of a motion, at times of its last step, with respect to all parameters.
#pragma once

#include <string>
#include <vector>

#include "lib/ode/integrator.h"
#include "lib/simulation/sensitivity/motion_sensitivity.h"

namespace orthodyn {

class MotionSlopes {
 public:
  // Both must outlive this object. The integrator computes these sensitivities.
  MotionSlopes(const Integrator& integrator, const MotionSensitivity& sensitivity)
      : integrator_(integrator), sensitivity_(sensitivity) {}

  // The time (s) at which the run starts or is resumed.
  void begin_at(double t) { start_ = t; }

  std::vector<std::string> paths() const;

  // By parameter, per its SI unit. `state`: the motion at a time of the last step, or at the start. `output`: one
  // number, at a fixed time.
  std::vector<double> derivatives(const SceneOutputs& output, const State& state) const;

 private:
  const Integrator& integrator_;
  const MotionSensitivity& sensitivity_;
  double start_ = 0;
};

}  // namespace orthodyn
