// How strongly damping acts on the motion itself, and whether that suffices for multistep methods of high order: they
// stall on vibrations that last, for part of the imaginary axis is unstable for them from order 3 on.
#pragma once

#include "integrators/critical_step.h"

namespace orthodyn {

// beta omega / 2 of stiffness-proportional damping in every region, at the frequency that the scales tell of the
// motion, about. `critical` has looked at a state.
double damping_ratio_of_motion(const CriticalStep& critical, const Scales& scales);

// rad/s.
double frequency_of_motion(const Scales& scales);

// Whether faster vibrations are gone soon enough.
bool suits_high_orders(double damping_ratio, double rtol);

}  // namespace orthodyn
