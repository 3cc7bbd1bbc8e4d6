// How far two figures are apart by their ratio.
#pragma once

#include <algorithm>
#include <cmath>

namespace orthodyn {

// The larger over the smaller of their magnitudes: at least 1. Neither is zero.
inline double ratio_distance(double a, double b) { return std::max(std::abs(a / b), std::abs(b / a)); }

}  // namespace orthodyn
