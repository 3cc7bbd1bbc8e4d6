// Estimates the error that remains after a correction of Newton's method with an old matrix, from the ratio of the last
// two corrections. The first correction of an equation is judged by the ratio in earlier equations with the same matrix
// (Hairer & Wanner 1996, IV.8).
#pragma once

#include <algorithm>
#include <cmath>

namespace orthodyn {

class RemainingError {
 public:
  // `linear`: true if all equations have the same ratio. This holds for a linear model whose matrix was factored with
  // the current step size.
  explicit RemainingError(bool linear) : linear_(linear) {}

  // Discards the ratio, because the matrix or gamma has changed.
  void restart() { factor_ = 1; }

  // Call it before each equation. Unless the model is linear, the new equation may converge more slowly than the last
  // one, so the estimate is raised.
  void begin() {
    if (!linear_ && factor_ < 1) factor_ = std::pow(std::max(factor_, kLeastFactor), kPower);
  }

  // Records the ratio of two successive corrections, in [0, 1).
  void note(double ratio) { factor_ = ratio / (1 - ratio); }

  // The error that remains after a correction of norm `size`; at least `least` times `size`.
  double after(double size, double least) const { return std::max(factor_, least) * size; }

 private:
  static constexpr double kLeastFactor = 1e-3;  // smaller values are round-off
  static constexpr double kPower = 0.8;
  bool linear_;
  double factor_ = 1;  // remaining error / last correction
};

}  // namespace orthodyn
