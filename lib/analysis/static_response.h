// Linear static response about rest to gravity and all loads at their peaks, and the amplitudes of vibrations that
// initial velocities and impulses start. Both estimate the size of the motion before integration.
#pragma once

#include <vector>

#include "lib/fem/fem_model.h"

namespace orthodyn {

struct StaticResponse {
  Vector load;                    // peak loads on the free coordinates in the initial shape, N
  Vector displacement;            // under `load`, m; empty if not computed, for example because the body is not held
  double work = 0;                // load . displacement, J
  double velocity_amplitude = 0;  // mass-weighted rms amplitude of vibrations started by initial velocities, m
  // Likewise if the impulses of all loads acted at once, m: an upper estimate for loads shorter than a period.
  double impulse_amplitude = 0;

  bool exists() const { return known; }
  bool known = false;  // whether a displacement was computed; a rank may have no unknowns
};

// Estimated largest displacement of the motion divided by twice the static response u: min(1, 1.5 impulse_amplitude /
// max |u|). Below 1 for short loads. It may then underestimate the motion of a light part.
double load_duration_factor(const VectorSpace& space, const StaticResponse& statics);

// Computes the response for a motion from the initial state to `end` (s).
StaticResponse static_response(const FemModel& model, const State& initial, double end);

// Peak force (N) of each term of Parts::loads between the initial time and `end` (s); zero for terms without a force at
// rest.
std::vector<Vector> peak_loads(const FemModel& model, const State& initial, double end);

// Displacement (m) under each load, by one factorisation. Empty where it cannot be computed; all are empty if the body
// is not held.
std::vector<Vector> static_displacements(const FemModel& model, const std::vector<Vector>& loads);

}  // namespace orthodyn
