#include "lib/fem/motion/rigid_motion.h"

#include <cmath>

namespace orthodyn {

NodalVector RigidMotion::displacements(double factor, const NodalVector& X) const {
  const double half = std::sin(angle_ * factor / 2);
  const double sine = std::sin(angle_ * factor), one_minus_cosine = 2 * half * half;  // all digits at small angles
  NodalVector u(3, X.cols());
  for (Eigen::Index i = 0; i < X.cols(); ++i) {
    const Vec3 across = axis_.cross(X.col(i) - point_);
    u.col(i) =
        factor * translation_ + (sine * across + one_minus_cosine * axis_.cross(across));  // s T + (R - I)(X - c)
  }
  return u;
}

Moved RigidMotion::at(double t, const NodalVector& X) const {
  const double s = factor_->value(t), rate = factor_->rate(t), curvature = factor_->curvature(t);
  const Vec3 spin = angle_ * rate * axis_, spin_rate = angle_ * curvature * axis_;
  Moved out{displacements(s, X), NodalVector(3, X.cols()), NodalVector(3, X.cols())};
  for (Eigen::Index i = 0; i < X.cols(); ++i) {
    const Vec3 arm = X.col(i) - point_ + (out.u.col(i) - s * translation_), turning = spin.cross(arm);
    out.v.col(i) = rate * translation_ + turning;
    out.a.col(i) = curvature * translation_ + spin_rate.cross(arm) + spin.cross(turning);
  }
  return out;
}

}  // namespace orthodyn
