// Interpolation of vectors over a step by polynomials of degree 5 through six Chebyshev points.
//
// The points lie inside the step, so that a jump at either end has no influence. They are irrational fractions of the
// step, so that a periodic load is not sampled only at its zeros.
#pragma once

#include <array>

#include "integrators/native/oscillator.h"

namespace orthodyn {

// The points as fractions of the step, in (0, 1).
const std::array<double, kLoadTerms>& chebyshev_points();

// Returns the coefficients c_k, as columns, of the polynomial sum_k c_k theta^k through `values`, one column per point.
// theta: fraction of the step. Equal values give an exactly constant polynomial.
Eigen::MatrixXd polynomial_coefficients(const Eigen::MatrixXd& values);

// sum_k c_k theta^k, and its first and second derivatives with respect to theta.
Vector polynomial_value(const Eigen::MatrixXd& coefficients, double theta);
Vector polynomial_slope(const Eigen::MatrixXd& coefficients, double theta);
Vector polynomial_curvature(const Eigen::MatrixXd& coefficients, double theta);

}  // namespace orthodyn
