// The norm of the error test, equal to SUNDIALS' weighted root mean square of (q, v) with n entries each:
//
//     sqrt((|q / (rtol * position scale)|^2 + |v / (rtol * velocity scale)|^2) / (2 n))
//
// An error of norm 1 is at the tolerance.
#pragma once

#include <cmath>

#include "lib/ode/integrator.h"

namespace orthodyn {

class ScaledNorm {
 public:
  // `space`: Model::space().
  ScaledNorm(double rtol, const Scales& scales, const VectorSpace& space = {})
      : position_(1 / (rtol * scales.position)), velocity_(1 / (rtol * scales.velocity)), rtol_(rtol), space_(space) {}

  double operator()(const ConstVectorRef& q, const ConstVectorRef& v) const {
    return root_mean(position_ * space_.stable_norm(q), velocity_ * space_.stable_norm(v), space_.size(q));
  }
  // The norm of (q, v) = (w_q x, w_v x).
  double operator()(const ConstVectorRef& x, double w_q, double w_v) const {
    const double size = space_.stable_norm(x);
    return root_mean(position_ * w_q * size, velocity_ * w_v * size, space_.size(x));
  }

  // The inverse: the root mean square of x if (w_q x, w_v x) has the norm `size`. w_q and w_v must not both be 0.
  double root_mean_square_at(double size, double w_q, double w_v) const {
    return size * std::sqrt(2.0) / std::hypot(position_ * w_q, velocity_ * w_v);
  }

  double rtol() const { return rtol_; }

 private:
  static double root_mean(double q, double v, Eigen::Index n) {
    return n ? std::hypot(q, v) / std::sqrt(2 * static_cast<double>(n)) : 0;
  }

  double position_, velocity_, rtol_;
  VectorSpace space_;
};

}  // namespace orthodyn
