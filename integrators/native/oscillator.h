// Closed-form solution of one oscillator, r'' + d r' + lambda r = p(t), whose load p is a polynomial over a step. It
// may be underdamped, critically damped or overdamped; lambda or d may be 0.
//
// tau is the time since the start of the step. With x = d tau and y = lambda tau^2, the solution uses
//
//   phi_k = sum_j b_j / (k+j)!,   b_0 = 1, b_1 = -x, b_j = -x b_{j-1} - y b_{j-2},
//   phi_k + x phi_{k+1} + y phi_{k+2} = 1/k!.
//
// The phi_k are divided differences, over the roots z1, z2 of z^2 + x z + y = 0, of the phi functions of exponential
// integrators (functions of one argument: Hochbruck & Ostermann, Exponential integrators, Acta Numerica 19, 2010). From
// rest, the response to the load tau^k/k! is r = tau^{k+2} phi_{k+2}, r' = tau^{k+1} phi_{k+1}. The response to a unit
// impulse is r = tau phi_1, r' = phi_0. All phi_k are evaluated without cancellation for all x, y >= 0.
#pragma once

#include <array>

#include "lib/core/types.h"

namespace orthodyn {

constexpr int kLoadTerms = 6;  // number of coefficients of a load polynomial (degree 5)

using OscillatorPhi = std::array<double, kLoadTerms + 2>;

// Computes phi_0 to phi_7. Precondition: x >= 0, y >= 0.
OscillatorPhi oscillator_phi(double x, double y);

struct Oscillation {
  double r, rate;
};

// State at the time tau > 0 (s) after `start` under the load p = sum_k c_k (tau/h)^k.
// Precondition: d >= 0 (1/s), lambda >= 0 (1/s^2), at most kLoadTerms terms, h > 0.
Oscillation oscillate(double d, double lambda, Oscillation start, const ConstVectorRef& c, double h, double tau);

}  // namespace orthodyn
