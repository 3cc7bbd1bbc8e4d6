// Magnitudes of matrices and operators, to scale problems for libraries that use absolute thresholds.
#pragma once

#include <functional>
#include <vector>

#include "lib/core/pattern.h"

namespace orthodyn {

// Returns 1 if x is not a positive normal number.
double nearest_power_of_two(double x);

// Return the diagonal and the dense form of a matrix on a symmetric pattern.
Vector diagonal(const Pattern& pattern, const std::vector<double>& values);
Eigen::MatrixXd dense_symmetric(const Pattern& pattern, const std::vector<double>& values);

// Estimates the largest eigenvalue of the n x n operator x -> second(first(x)) by three steps of the power method,
// starting from a vector without symmetry. The error is about ten per cent if that eigenvalue is well separated. The
// result is at least the smallest positive normal number. Both functions write to their second argument, which has n
// entries.
using VectorFunction = std::function<void(const Vector&, Vector&)>;
double operator_norm(int n, const VectorFunction& first, const VectorFunction& second);

}  // namespace orthodyn
