// Rigid motion with one factor s(t): a rotation R by the angle s phi about an axis, and a translation s T of the axis,
//   u = s T + (R - I)(X - c),  v = s' T + w x r,  a = s'' T + w' x r + w x (w x r).
// X is the rest position, c a point on the axis, e the axis direction, r = R (X - c), w = phi s' e the angular
// velocity; a prime is a time derivative. Valid for angles of any size.
#include <cmath>

#include "lib/fem/motion/motion.h"
#include "lib/fem/time_functions/time_function.h"

namespace orthodyn {

namespace {

class RigidMotion : public Motion {
 public:
  RigidMotion(const Vec3& translation, const Vec3& point, const Vec3& axis, double angle,
              std::shared_ptr<const TimeFunction> factor)
      : translation_(translation), point_(point), axis_(axis), angle_(angle), factor_(std::move(factor)) {}

  Moved at(double t, const NodalVector& X) const override {
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

  // Scales the factor, so that rotating points stay on their arcs.
  NodalVector part_of_way(double share, double t, const NodalVector& X) const override {
    return displacements(share * factor_->value(t), X);
  }

  std::vector<double> kinks() const override { return factor_->kinks(); }
  bool has_continuous_velocity() const override { return factor_->has_continuous_rate(); }
  StepLimits step_limits(double start, double end, const NodalVector&) const override {
    return factor_->step_limits(start, end);
  }

 private:
  NodalVector displacements(double factor, const NodalVector& X) const {
    const double half = std::sin(angle_ * factor / 2);
    const double sine = std::sin(angle_ * factor), one_minus_cosine = 2 * half * half;  // accurate at small angles
    NodalVector u(3, X.cols());
    for (Eigen::Index i = 0; i < X.cols(); ++i) {
      const Vec3 across = axis_.cross(X.col(i) - point_);
      u.col(i) =
          factor * translation_ + (sine * across + one_minus_cosine * axis_.cross(across));  // s T + (R - I)(X - c)
    }
    return u;
  }

  Vec3 translation_, point_, axis_;
  double angle_;
  std::shared_ptr<const TimeFunction> factor_;
};

}  // namespace

std::shared_ptr<const Motion> rigid_motion(const Vec3& translation, const Vec3& point, const Vec3& axis, double angle,
                                           std::shared_ptr<const TimeFunction> factor) {
  return std::make_shared<RigidMotion>(translation, point, axis, angle, std::move(factor));
}

}  // namespace orthodyn
