// How an error must fall with the tolerance.
#pragma once

#include <functional>
#include <vector>

namespace orthodyn {

// The slope of log error against log rtol, by least squares.
double slope(const std::vector<double>& rtols, const std::vector<double>& errors);

// A method of order k whose step error is held at rtol has a global error of about rtol^(k/(k+1)).
// Step and order jump with rtol, and with them single errors by a factor of 3: many decades level that. A
// method of order one would need a million steps for the last ones.
void expect_order(int order, const std::function<double(double rtol)>& error);

}  // namespace orthodyn
