// Methods of two parts: the trapezoidal rule to a time g h within the step, then
//
//   y1 = y0 + h (q0 f(y0) + q1 f(y_g) + q2 f(y1)),    q0 = 1 - q1 - q2,    q1 g + q2 = 1/2.
//
// Both stages are of order two, so that the quadrature rule of order three through the three slopes estimates the
// local error (Hosea & Shampine 1996).
#pragma once

#include "integrators/native/dirk.h"

namespace orthodyn {

inline DirkTable composite_table(double g, double q1, double q2) {
  const double q0 = 1 - q1 - q2;
  const double b1 = 1 / (6 * g * (1 - g)), b2 = 0.5 - g * b1, b0 = 1 - b1 - b2;
  return {2, 3, {0, g, 1}, {{g / 2, g / 2}, {q0, q1, q2}}, {b0 - q0, b1 - q1, b2 - q2}};
}

}  // namespace orthodyn
