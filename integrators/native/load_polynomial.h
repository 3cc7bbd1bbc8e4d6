// Interpolation of vectors over a step by polynomials of degree 5, from their values at Chebyshev's six points.
//
// The points lie inside of the step: what a load is beyond a jump at either end has no part in it. None of them is a
// rational share of the step, so that no periodic load is sampled in its zeros only.
#pragma once

#include <array>

#include "integrators/native/oscillator.h"

namespace orthodyn {

// Shares of the step, in (0, 1).
const std::array<double, kLoadTerms>& load_points();

// Columns c_k of sum_k c_k theta^k from columns of values at the points; exactly constant where the values are equal.
Eigen::MatrixXd load_coefficients(const Eigen::MatrixXd& values);

// sum_k c_k theta^k, and its first and second derivatives.
Vector load_value(const Eigen::MatrixXd& coefficients, double theta);
Vector load_slope(const Eigen::MatrixXd& coefficients, double theta);
Vector load_curvature(const Eigen::MatrixXd& coefficients, double theta);

}  // namespace orthodyn
