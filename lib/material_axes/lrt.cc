#include "lib/material_axes/lrt.h"

#include <cmath>

#include "lib/material_axes/frame.h"

namespace orthodyn {

Mat3 lrt_axes(const Vec3& along, const Vec3& radial, LrtOrder order, double spiral) {
  Mat3 lrt = frame(along, radial);
  const Vec3 L = lrt.col(0), T = lrt.col(2);
  lrt.col(0) = std::cos(spiral) * L + std::sin(spiral) * T;
  lrt.col(2) = std::cos(spiral) * T - std::sin(spiral) * L;
  return in_order(lrt, "LRT", Value<LrtOrder>::yaml(order));
}

}  // namespace orthodyn
