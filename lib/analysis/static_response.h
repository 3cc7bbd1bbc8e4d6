// The linear static response about rest to gravity and to all loads at the peaks of their factors: how far
// the body will move, roughly, before anything is integrated.
#pragma once

#include "lib/fem/fem_model.h"

namespace orthodyn {

struct StaticResponse {
  Vector load;          // N, on the free coordinates
  Vector displacement;  // m; empty if there is no load or the body is not held
  double work = 0;      // J, load . displacement

  bool exists() const { return displacement.size() > 0; }
};

// Of the time from `start` to `end`, s.
StaticResponse static_response(const FemModel& model, double start, double end);

}  // namespace orthodyn
