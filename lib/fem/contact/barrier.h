// The barrier of contact: B(s) = (1 - s)^3 / s of the relative distance 0 < s < 1, and 0 beyond. It has two continuous
// derivatives. Its energy grows as 1/s, so that the distance of an impact of any energy can be represented; that of Li
// et al. (2020), -(1 - s)^2 ln s, grows so slowly that an impact of 130 times the energy at s = 1/2 needs s = 1e-10.
#pragma once

namespace orthodyn {

inline double barrier(double s) { return s >= 1 ? 0 : (1 - s) * (1 - s) * (1 - s) / s; }
inline double barrier_slope(double s) { return s >= 1 ? 0 : -(1 - s) * (1 - s) * (1 + 2 * s) / (s * s); }
inline double barrier_curvature(double s) { return s >= 1 ? 0 : 2 * (1 - s) * (1 + s + s * s) / (s * s * s); }

}  // namespace orthodyn
