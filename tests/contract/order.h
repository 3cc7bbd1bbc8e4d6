// Expected decrease of the error with the tolerance.
#pragma once

#include <functional>
#include <vector>

namespace orthodyn {

// Least squares slope of log error against log rtol.
double slope(const std::vector<double>& rtols, const std::vector<double>& errors);

// A method of order k with the step error held at rtol has a global error of about rtol^(k/(k+1)). Step and order jump
// with rtol, and single errors with them by a factor of 3, so the slope is fitted over many decades. A method of order
// one would need a million steps for the last ones.
void expect_order(int order, const std::function<double(double rtol)>& error);

}  // namespace orthodyn
