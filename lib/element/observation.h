// Stress, axes and strain at a material point, for output.
#pragma once

#include <limits>

#include "lib/element/batch.h"

namespace orthodyn {

// For one point, or for a batch of points (T = Batch).
template <class T>
struct PointObservationOf {
  Mat3T<T> cauchy;  // elastic Cauchy stress in space, Pa; NaN if det F <= 0
  Mat3T<T> axes;    // columns: the material axes, rotated with the material
  Mat3T<T> strain;  // S - I (small strain: sym(F) - I) in material axes
};
using PointObservation = PointObservationOf<double>;

inline PointObservation lane_of(const PointObservationOf<Batch>& all, int lane) {
  const auto one = [&](const Mat3T<Batch>& m) -> Mat3 { return m.unaryExpr([&](const Batch& x) { return x[lane]; }); };
  return {one(all.cauchy), one(all.axes), one(all.strain)};
}

// Cauchy stress from P Q and F Q. If it is not symmetric (warped law), its symmetric part; NaN if det F <= 0.
inline Mat3 cauchy_stress(const Mat3& P, const Mat3& F) {
  const double det_F = F.determinant();
  if (!(det_F > 0)) return Mat3::Constant(std::numeric_limits<double>::quiet_NaN());
  const Mat3 s = P * F.transpose() / det_F;
  return 0.5 * (s + s.transpose());
}

}  // namespace orthodyn
