#include "lib/fem/motion/rigid_motion.h"

#include <cmath>

namespace orthodyn {

Moved RigidMotion::at(double t, const NodalVector& X) const {
  const double s = factor_->value(t), rate = factor_->rate(t), curvature = factor_->curvature(t);
  const double half = std::sin(angle_ * s / 2);
  const double sine = std::sin(angle_ * s), one_minus_cosine = 2 * half * half;  // with all digits at small angles
  const Vec3 spin = angle_ * rate * axis_, spin_rate = angle_ * curvature * axis_;
  Moved out{NodalVector(3, X.cols()), NodalVector(3, X.cols()), NodalVector(3, X.cols())};
  for (Eigen::Index i = 0; i < X.cols(); ++i) {
    const Vec3 rest = X.col(i) - point_, across = axis_.cross(rest);
    const Vec3 turned = sine * across + one_minus_cosine * axis_.cross(across);  // (R - I) (X - c)
    const Vec3 arm = rest + turned, turning = spin.cross(arm);
    out.u.col(i) = s * translation_ + turned;
    out.v.col(i) = rate * translation_ + turning;
    out.a.col(i) = curvature * translation_ + spin_rate.cross(arm) + spin.cross(turning);
  }
  return out;
}

}  // namespace orthodyn
