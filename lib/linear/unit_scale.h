// Sizes of matrices and operators, by which problems get units in which their entries are about one: libraries compare
// with absolute thresholds.
#pragma once

#include <functional>
#include <vector>

#include "lib/core/pattern.h"

namespace orthodyn {

// 1 for what is no positive normal number.
double nearest_power_of_two(double x);

// Of a matrix on a symmetric pattern, n.
Vector diagonal(const Pattern& pattern, const std::vector<double>& values);

// The size of the operator x -> second(first(x)), n x n, by three steps of the power method from an irregular vector:
// from below, its largest eigenvalue to some ten per cent where it is well above the others. At least the smallest
// normal number. Both functions write to their second argument, of n entries.
using VectorFunction = std::function<void(const Vector&, Vector&)>;
double operator_size(int n, const VectorFunction& first, const VectorFunction& second);

}  // namespace orthodyn
