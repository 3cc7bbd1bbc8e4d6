// One oscillator in closed form, r'' + d r' + lambda r = p(t), for loads p that are polynomials over a step:
// underdamped, critically damped, overdamped, and lambda = 0 or d = 0.
//
// With x = d tau, y = lambda tau^2 and z1, z2 the roots of z^2 + x z + y = 0, what is needed are
//
//   phi_k = sum_j b_j / (k+j)!,   b_0 = 1, b_1 = -x, b_j = -x b_{j-1} - y b_{j-2},
//   phi_k + x phi_{k+1} + y phi_{k+2} = 1/k!,
//
// the divided differences over z1, z2 of the functions of exponential integrators. At rest at first, the oscillator
// responds to the load tau^k/k! with r = tau^{k+2} phi_{k+2} and r' = tau^{k+1} phi_{k+1}; tau phi_1 is its response to
// a unit impulse and phi_0 that response's rate. No x or y >= 0 makes them cancel.
// Source: Hochbruck & Ostermann, Exponential integrators, Acta Numerica 19, 2010, for functions of one argument.
#pragma once

#include <array>

#include "lib/core/types.h"

namespace orthodyn {

constexpr int kLoadTerms = 6;  // of a load: of degree 5 at most

using OscillatorPhi = std::array<double, kLoadTerms + 2>;

// phi_0 to phi_7. Precondition: x >= 0, y >= 0.
OscillatorPhi oscillator_phi(double x, double y);

struct Oscillation {
  double r, rate;
};

// After a time tau > 0, s, from `start`, under the load p = sum_k c_k (tau/h)^k.
// Precondition: d >= 0 (1/s), lambda >= 0 (1/s^2), at most kLoadTerms terms, h > 0.
Oscillation oscillate(double d, double lambda, Oscillation start, const ConstVectorRef& c, double h, double tau);

}  // namespace orthodyn
