// Dense output of one-step methods for q' = v, v' = a: the quintic Hermite polynomial through q, v
// and a at both ends of a step, and its derivative for v.
//
// Errors of O(h^6) in q and O(h^5) in v over a step of length h, at no evaluation of the model
// (Hairer, Norsett & Wanner 1993, II.6, with three conditions per end).
#pragma once

#include "lib/ode/output.h"

namespace orthodyn {

// The solution at an end of a step; a = M^-1 f.
struct StepEnd {
  double t = 0;
  Vector q, v, a;
};

// q and v at a time between the ends. At an end, exactly the stored values.
void interpolate(const StepEnd& begin, const StepEnd& end, double t, VectorRef q, VectorRef v);

// The same by linear interpolation, O(h^2): enough for a method of order 1.
void interpolate_linearly(const StepEnd& begin, const StepEnd& end, double t, VectorRef q, VectorRef v);

// The middle of the ends' positions, with the mean velocity of the step.
State mean_state(const StepEnd& begin, const StepEnd& end);

}  // namespace orthodyn
