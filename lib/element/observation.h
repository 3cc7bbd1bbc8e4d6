// Stress, axes and strain at a material point, for output.
#pragma once

#include <limits>

#include "lib/core/types.h"

namespace orthodyn {

struct PointObservation {
  Mat3 cauchy;  // elastic Cauchy stress in space, Pa; NaN if det F <= 0
  Mat3 axes;    // columns: the material axes, rotated with the material
  Mat3 strain;  // S - I (small strain: sym(F) - I) in material axes
};

// Cauchy stress from P Q and F Q. If it is not symmetric (warped law), its symmetric part; NaN if det F <= 0.
inline Mat3 cauchy_stress(const Mat3& P, const Mat3& F) {
  const double det_F = F.determinant();
  if (!(det_F > 0)) return Mat3::Constant(std::numeric_limits<double>::quiet_NaN());
  const Mat3 s = P * F.transpose() / det_F;
  return 0.5 * (s + s.transpose());
}

}  // namespace orthodyn
