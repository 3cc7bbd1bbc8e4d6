// The linear response about rest: to gravity and to all loads at the peaks of their factors, and to initial velocities.
// How far the body will move, roughly, before anything is integrated.
#pragma once

#include "lib/fem/fem_model.h"

namespace orthodyn {

struct StaticResponse {
  Vector load;           // N, on the free coordinates of the initial shape
  Vector displacement;   // m, under the load; empty if there is nothing to respond to or the body is not held
  double work = 0;       // J, load . displacement
  double vibration = 0;  // m, root mean square over the mass of the amplitudes that the initial velocities start

  bool exists() const { return displacement.size() > 0; }
};

// From the initial state to the time `end`, s.
StaticResponse static_response(const FemModel& model, const State& initial, double end);

}  // namespace orthodyn
