// Estimates the damping ratio of the motion, and decides whether it suffices for multistep methods of high order. At
// order 3 and above, part of the imaginary axis lies outside their stability region, so persistent vibrations force
// tiny steps.
#pragma once

#include "integrators/critical_step.h"

namespace orthodyn {

// Damping ratio beta omega / 2 of the motion if every region has damping D = beta K, with beta =
// critical.damping_time() and omega = frequency_of_motion(scales). Precondition: `critical` has been evaluated at a
// state.
double damping_ratio_of_motion(const CriticalStep& critical, const Scales& scales);

// Estimated angular frequency of the motion, rad/s.
double frequency_of_motion(const Scales& scales);

// True if vibrations faster than the motion decay soon enough for orders 3 to 5.
bool suits_high_orders(double damping_ratio, double rtol);

}  // namespace orthodyn
