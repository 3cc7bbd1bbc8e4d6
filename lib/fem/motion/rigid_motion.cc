#include "lib/fem/motion/rigid_motion.h"

namespace orthodyn {

Moved RigidMotion::at(double t, const NodalVector& X) const {
  const double s = factor_->value(t), rate = factor_->rate(t), curvature = factor_->curvature(t);
  const Mat3 R = Eigen::AngleAxisd(angle_ * s, axis_).toRotationMatrix();
  const Vec3 spin = angle_ * rate * axis_, spin_rate = angle_ * curvature * axis_;
  Moved out{NodalVector(3, X.cols()), NodalVector(3, X.cols()), NodalVector(3, X.cols())};
  for (Eigen::Index i = 0; i < X.cols(); ++i) {
    const Vec3 arm = R * (X.col(i) - point_), turning = spin.cross(arm);
    out.x.col(i) = point_ + s * translation_ + arm;
    out.v.col(i) = rate * translation_ + turning;
    out.a.col(i) = curvature * translation_ + spin_rate.cross(arm) + spin.cross(turning);
  }
  return out;
}

}  // namespace orthodyn
