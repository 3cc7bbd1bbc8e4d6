// The time `later` (s) of a difference quotient (f(later) - f(t)) / (later - t) at the start t of a step h. It lies
// after t, because f may have a kink at t, and inside the step if h > 1e-10 |t|. Divide by later - t as computed,
// because `later` is rounded.
#pragma once

#include <algorithm>
#include <cmath>

namespace orthodyn {

inline double shortly_after(double t, double h) { return t + std::max(1e-6 * h, 1e-10 * std::abs(t)); }

}  // namespace orthodyn
