// How large motion and velocity will be, roughly: what error tolerances are relative to.
//
// Position: a tenth of the body's largest extent L; less if it is known to move less: twice the linear static
// deflection u under all loads at their peaks, or twice as far as moved supports go, and of a body that is held three
// times the amplitude of the vibrations that initial velocities start; of short loads no more than three times that of
// the vibrations that their impulses start. Where it may touch something whose stiffness at
// a node is k, at most sqrt(2 (E0 + W) / k), but not below 1e-6 L: errors of position are errors of the energy of
// contact. Velocity: 3 sqrt(2 (E0 + W) / m + V^2), with E0 the initial elastic and kinetic energy, m the mass, W the
// work of the peak loads through that deflection, of short loads with the square of the share of it that they reach,
// for an unclamped body through L, and V the largest speed of moved supports.
// Frequency: 2/3 of velocity over position where that of the motion itself is known: one is three times a root mean
// square, the other twice a size.
#pragma once

#include "lib/analysis/static_response.h"
#include "lib/ode/integrator.h"

namespace orthodyn {

// Of a body that moves from its initial state to the time `end` (s). `statics` is static_response() of this very model
// and initial state. Throws ConfigError if the initial state has no finite energy.
Scales estimate_scales(const FemModel& model, const State& initial, double end, const StaticResponse& statics);

}  // namespace orthodyn
