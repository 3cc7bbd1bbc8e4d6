// Step control with a dead band, for methods to which a change of the step costs a factorisation: none between an
// eighth and two thirds of the tolerance (at error order 3). The step grows no further than the trend of the errors
// allows (Gustafsson 1994; Hairer & Wanner 1996, IV.8). Errors are in units of the tolerance; a step with one above 1
// is refused.
#pragma once

#include <algorithm>
#include <cmath>

namespace orthodyn {

class DeadbandStepControl {
 public:
  // The local error falls with h to the power of `error_order`.
  explicit DeadbandStepControl(double error_order) : order_(error_order) {}

  // By what the step may change after one of length h with an error of at most 1, in units of the tolerance.
  double after_success(double h, double error) {
    error = std::max(error, kSmallestError);
    double factor = elementary(error);
    if (factor > kHoldTo && last_h_ > 0)
      factor = std::max(1.0, factor * std::min(1.0, h / last_h_ * std::pow(last_error_ / error, 1 / order_)));
    last_h_ = h;
    last_error_ = error;
    return factor >= kHoldFrom && factor <= kHoldTo ? 1 : std::clamp(factor, kShrink, kGrow);
  }
  double after_failure(double error) const { return std::clamp(elementary(error), kShrink, kSafety); }

 private:
  double elementary(double error) const { return kSafety * std::pow(error, -1 / order_); }

  static constexpr double kSafety = 0.75, kShrink = 0.2, kGrow = 5, kHoldFrom = 0.85, kHoldTo = 1.5;
  static constexpr double kSmallestError = 1e-6;
  double order_, last_h_ = 0, last_error_ = 1;
};

}  // namespace orthodyn
