// Where a difference quotient in time, (f(later) - f(t)) / (later - t), is taken for a step h from t: into the
// step, for a kink may lie before it, and no closer than t has digits for. Divide by later - t, which is exact.
#pragma once

#include <algorithm>
#include <cmath>

namespace orthodyn {

inline double shortly_after(double t, double h) { return t + std::max(1e-6 * h, 1e-10 * std::abs(t)); }

}  // namespace orthodyn
