// The factor between two numbers, regardless of which is larger.
#pragma once

#include <algorithm>
#include <cmath>

namespace orthodyn {

// max(|a/b|, |b/a|) >= 1. Precondition: neither is zero.
inline double ratio_distance(double a, double b) { return std::max(std::abs(a / b), std::abs(b / a)); }

}  // namespace orthodyn
