// Dense output of one-step methods for q' = v, v' = a: the quintic Hermite polynomial through q, v and a at both ends
// of a step, and its derivative for v. Error O(h^6) in q and O(h^5) in v for a step h, without evaluations of the model
// (Hairer, Norsett & Wanner 1993, II.6, with three conditions per end).
#pragma once

#include "lib/ode/output.h"

namespace orthodyn {

// The solution at one end of a step. `a`: the method's own acceleration, approximately M^-1 f. `lambda`: multipliers of
// constraints (constraints.h), if the model has any; they are interpolated linearly, with the error O(h^2).
struct StepEnd {
  double t = 0;
  Vector q, v, a, lambda = {};
};

// Computes q and v at a time t within the step; at its ends they are exactly the stored values.
void interpolate(const StepEnd& begin, const StepEnd& end, double t, VectorRef q, VectorRef v);

// Linear interpolation, error O(h^2), for methods of order 1.
void interpolate_linearly(const StepEnd& begin, const StepEnd& end, double t, VectorRef q, VectorRef v);

// Mean of the positions q0 and q1 and of the multipliers at both ends, with the mean velocity (q1 - q0)/h.
State mean_state(const StepEnd& begin, const StepEnd& end);

}  // namespace orthodyn
