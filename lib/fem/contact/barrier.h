// The barrier of contact: B(s) = -(1 - s)^2 ln s of the relative distance 0 < s < 1, and 0 beyond. It has two
// continuous derivatives and grows without limit as s goes to 0. Source: Li et al. (2020), Incremental Potential
// Contact, ACM Trans. Graph. 39.
#pragma once

#include <cmath>

namespace orthodyn {

inline double barrier(double s) { return s >= 1 ? 0 : -(1 - s) * (1 - s) * std::log(s); }
inline double barrier_slope(double s) { return s >= 1 ? 0 : (1 - s) * (2 * std::log(s) - (1 - s) / s); }
inline double barrier_curvature(double s) { return s >= 1 ? 0 : -2 * std::log(s) + (1 - s) / s * (4 + (1 - s) / s); }

}  // namespace orthodyn
