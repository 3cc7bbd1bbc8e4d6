// A rigid motion by one factor s(t): a rotation by the angle phi s about an axis that is itself translated by s T,
//   u = s T + (R - I)(X - c),  v = s' T + w x r,  a = s'' T + w' x r + w x (w x r),
// with r = R (X - c), w = phi s' e, w' = phi s'' e; for angles of any size.
#pragma once

#include <memory>

#include "lib/fem/motion/motion.h"
#include "lib/fem/time_functions/time_function.h"

namespace orthodyn {

class RigidMotion : public Motion {
 public:
  // m at factor 1; m, a unit vector, rad at factor 1.
  RigidMotion(const Vec3& translation, const Vec3& point, const Vec3& axis, double angle,
              std::shared_ptr<const TimeFunction> factor)
      : translation_(translation), point_(point), axis_(axis), angle_(angle), factor_(std::move(factor)) {}

  Moved at(double t, const NodalVector& X) const override;
  // By the same share of the factor: what turns does so about its axis.
  NodalVector part_of_way(double share, double t, const NodalVector& X) const override {
    return displacements(share * factor_->value(t), X);
  }
  std::vector<double> kinks() const override { return factor_->kinks(); }
  bool has_continuous_velocity() const override { return factor_->has_continuous_rate(); }
  StepLimits step_limits(double start, double end, const NodalVector&) const override {
    return factor_->step_limits(start, end);
  }

 private:
  NodalVector displacements(double factor, const NodalVector& X) const;

  Vec3 translation_, point_, axis_;
  double angle_;
  std::shared_ptr<const TimeFunction> factor_;
};

}  // namespace orthodyn
