// The smooth penalty of contact: psi(d) of the depth d, with the onset w,
//   psi'(d) = 0 for d <= 0,  d^2/(2 w) for 0 < d < w,  d - w/2 for d >= w.
#pragma once

#include <cmath>
#include <limits>

namespace orthodyn {

inline double penalty(double d, double w) {
  return d <= 0 ? 0 : d < w ? d * d * d / (6 * w) : d * (d - w) / 2 + w * w / 6;
}
inline double penalty_slope(double d, double w) { return d <= 0 ? 0 : d < w ? d * d / (2 * w) : d - w / 2; }
inline double penalty_curvature(double d, double w) { return d <= 0 ? 0 : d < w ? d / w : 1; }

// The depth (m) at which a penalty of the stiffness k (N/m) without onset has this energy (J). Infinite if k is 0.
inline double penalty_depth(double energy, double k) {
  return k > 0 ? std::sqrt(2 * energy / k) : std::numeric_limits<double>::infinity();
}

}  // namespace orthodyn
