// The linear response about rest: to gravity and to all loads at the peaks of their factors, and to initial velocities.
// How far the body will move, roughly, before anything is integrated.
#pragma once

#include <vector>

#include "lib/fem/fem_model.h"

namespace orthodyn {

struct StaticResponse {
  Vector load;           // N, on the free coordinates of the initial shape
  Vector displacement;   // m, under the load; empty if there is nothing to respond to or the body is not held
  double work = 0;       // J, load . displacement
  double vibration = 0;  // m, root mean square over the mass of the amplitudes that the initial velocities start
  double struck = 0;     // m, likewise, that the impulses of all loads would start if they came at once: blows that end
                         // within a period leave no more

  bool exists() const { return known; }
  bool known = false;  // whether there is a displacement; of several ranks some may have no unknowns
};

// Largest displacement of the motion over twice the static response: min(1, 1.5 struck / max |u|), without dimension.
// Below 1 for short blows, where it may underestimate the motion of a light part.
double share_reached(const VectorSpace& space, const StaticResponse& statics);

// From the initial state to the time `end`, s.
StaticResponse static_response(const FemModel& model, const State& initial, double end);

// The load of each of the model's terms of load alone, N, at its peak; zero for those that do nothing at rest.
std::vector<Vector> peak_loads(const FemModel& model, const State& initial, double end);

// The displacement under each load, m, by one factorisation; all empty if the body is not held.
std::vector<Vector> static_displacements(const FemModel& model, const std::vector<Vector>& loads);

}  // namespace orthodyn
