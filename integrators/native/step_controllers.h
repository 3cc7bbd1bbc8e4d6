// Step size controllers. Errors are in units of the tolerance; a step with an error above 1 is rejected.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <string>

#include "lib/core/cause.h"
#include "lib/core/errors.h"
#include "lib/ode/statistics.h"

namespace orthodyn {

// Proportional-integral controller: uses the errors of this step and of the last one (Gustafsson 1991; Hairer & Wanner
// 1996, IV.2).
class PiStepController {
 public:
  // The local error is proportional to h to the power of `error_order`.
  explicit PiStepController(double error_order) : order_(error_order) {}

  void restart() { last_error_ = 1; }

  // Factor by which the step changes after an accepted step, and after a rejected one.
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

// Repeats a step until its local error is within the tolerance, and proposes the next one.
class AdaptiveStep {
 public:
  // The local error is proportional to h to the power of `error_order`.
  explicit AdaptiveStep(double error_order) : controller_(error_order) {}

  void restart() {
    h_ = 0;
    controller_.restart();
  }

  // Length (s) proposed for the next step; 0 after a restart, when the caller must estimate and propose() it.
  double proposed() const { return h_; }
  void propose(double h) { h_ = h; }

  // Why the model refused the last attempt; empty if it did not.
  const Cause& cause() const { return cause_; }

  // Takes one step. length() returns the step to attempt, at most proposed(). attempt(h) returns the error, or nothing
  // if there is no result; it may throw RecoverableError. rejected(has_error) is called after a failed attempt, and
  // throws if proposed() has become too short.
  template <class Length, class Attempt, class Rejected>
  void take(Statistics& statistics, Length length, Attempt attempt, Rejected rejected) {
    for (bool refused = false;; refused = true) {
      const double h = length();
      const std::optional<double> error = try_recoverably(attempt, h);
      if (error && *error <= 1) {
        const double factor = controller_.after_success(*error);
        const double proposed = h * (refused ? std::min(factor, 1.0) : factor);
        h_ = h < h_ ? std::max(h_, proposed) : proposed;  // a step shortened by length() must not reduce h_
        return;
      }
      ++statistics.rejected_steps;
      ++(error ? statistics.error_test_failures : statistics.convergence_failures);
      h_ = h * (error ? controller_.after_failure(*error) : kRetryFactor);
      rejected(error.has_value());
    }
  }

  // True if proposed() is at most h_min (s) or the resolution of floating-point time at t (s).
  bool is_too_short(double h_min, double t) const {
    const double resolution = 4 * std::numeric_limits<double>::epsilon() * std::abs(t);
    return !(h_ > std::max({h_min, resolution, std::numeric_limits<double>::min()}));
  }

 private:
  template <class Attempt>
  std::optional<double> try_recoverably(Attempt& attempt, double h) {
    cause_.clear();
    try {
      return attempt(h);
    } catch (const RecoverableError& e) {
      cause_.note(e);
      return std::nullopt;
    }
  }

  static constexpr double kRetryFactor = 0.25;  // factor after an attempt without a result
  PiStepController controller_;
  double h_ = 0;
  Cause cause_;
};

// Predictive controller (Gustafsson 1994; Hairer & Wanner 1996, IV.8) with a dead band, for methods in which a new step
// size costs a factorisation. At error order 3 the step is kept for errors between 0.125 and 0.69. The step grows no
// faster than the trend of the errors permits.
class PredictiveStepController {
 public:
  // The local error is proportional to h to the power of `error_order`.
  explicit PredictiveStepController(double error_order) : order_(error_order) {}

  // Factor by which the step changes after an accepted step of length h, and after a rejected one.
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
