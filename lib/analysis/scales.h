// Estimates the size of positions and velocities and the frequency of the motion. Error tolerances are relative to
// these scales.
//
// Notation: L is the body's largest extent, m its mass, V the largest speed of moved supports and motors, E0 the
// initial kinetic energy and the elastic energy that the start releases, at most the sum of |f q|/2 over the
// coordinates of a displaced body with the forces f: none of a body under tension in equilibrium. u is the largest
// static deflection under the peak loads, c = load_duration_factor(). W is the work of the peak loads through the
// static displacement times c^2, or through the distance L if the body is not held.
//
//   Position: L / 10, or the size of the motion if it is known to be smaller. The size is the sum of twice the larger
//   of c u and the largest support displacement, three times the amplitude of vibrations that initial velocities start,
//   and the initial displacement. Contact of nodal stiffness k limits the position to sqrt(2 (E0 + W) / k), but not
//   below 1e-6 L, because position errors become errors of the contact energy.
//   Velocity: 3 sqrt(2 (E0 + W) / m + V^2), or L / duration if this expression is zero.
//   Frequency: 2/3 velocity / size if the size of the motion is below L / 10, otherwise unknown (0). The factor is 2/3
//   because the velocity is three times an rms value and the size twice an amplitude.
#pragma once

#include "lib/analysis/static_response.h"
#include "lib/ode/integrator.h"

namespace orthodyn {

// Estimates the scales of a motion from the initial state to `end` (s). `statics`: static_response() of this model and
// initial state. Throws ConfigError if the initial state has no finite energy.
Scales estimate_scales(const FemModel& model, const State& initial, double end, const StaticResponse& statics);

}  // namespace orthodyn
