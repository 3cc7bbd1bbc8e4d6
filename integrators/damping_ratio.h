// Estimates the damping ratio of the motion, and decides whether it suffices for multistep methods of high order. At
// order 3 and above, part of the imaginary axis lies outside their stability region, so persistent vibrations force
// tiny steps.
#pragma once

#include "integrators/critical_step.h"

namespace orthodyn {

// Damping ratio beta omega / 2 of the motion of a task, with the damping time beta (s) and omega =
// frequency_of_motion(scales). beta is D/K of the fastest vibration, critical.damping_time(). All vibrations have this
// beta if every region has damping D = beta K and the start is the rest shape. In a displaced body, tension adds
// stiffness without damping; beta is then at most D/K of vibrations about as fast as the motion or the run.
// Precondition: `critical` has been evaluated at the start. Throws the model's RecoverableError. Collective.
double damping_ratio_of_motion(const Model& model, const Task& task, const CriticalStep& critical,
                               const Scales& scales);

// Estimated angular frequency of the motion, rad/s.
double frequency_of_motion(const Scales& scales);

// True if vibrations faster than the motion decay soon enough for orders 3 to 5.
bool suits_high_orders(double damping_ratio, double rtol);

}  // namespace orthodyn
