// Proportional-integral control of the step: from the errors of this step and of the last one, in units of
// the tolerance (Gustafsson 1991; Hairer & Wanner 1996, IV.2).
#pragma once

#include <algorithm>
#include <cmath>

namespace orthodyn {

class StepControl {
 public:
  // The local error falls with h to the power of `error_order`.
  explicit StepControl(double error_order) : order_(error_order) {}

  void restart() { last_error_ = 1; }

  // By what the step may change, after an accepted and after a refused one.
  double after_success(double error) {
    error = std::max(error, kSmallestError);
    const double factor = kSafety * std::pow(error, -0.7 / order_) * std::pow(last_error_, 0.4 / order_);
    last_error_ = error;
    return std::clamp(factor, kShrink, kGrow);
  }
  double after_failure(double error) const {
    return std::clamp(kSafety * std::pow(error, -1 / order_), kShrink, kSafety);
  }

 private:
  static constexpr double kSafety = 0.9, kShrink = 0.2, kGrow = 5, kSmallestError = 1e-4;
  double order_, last_error_ = 1;
};

}  // namespace orthodyn
