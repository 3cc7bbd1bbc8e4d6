// Decides when the matrix of Newton's method is renewed: its tangent computed and factored.
//
// An old matrix takes more iterations the further the state has moved. A new one costs as much as `cost` iterations.
// The mean cost of a solve since the last renewal, renewal included, falls at first. The matrix is renewed when a solve
// has taken more iterations than this mean, because from then on the mean rises.
//
// Newton's method may also fail with an old matrix, as in large rotations. After four such failures in a row each solve
// gets a new matrix; after 4 to 64 such solves an old matrix is tried again. Not thread-safe.
#pragma once

#include <algorithm>
#include <cmath>

#include "lib/ode/model.h"

namespace orthodyn {

// Estimated cost of a new matrix in iterations: the time of a tangent and a factorisation, divided by the time of a
// force and a solve. Measured costs are 0.7 to 1.4 times the estimate (docs/decisions.md). The estimate depends only on
// the number of unknowns, so the rule is the same on each machine and with each linear solver.
inline double renewal_cost(const Model& model) {
  return std::max(5.0, 0.4 * std::cbrt(static_cast<double>(model.num_dofs_of_all())));
}

class RenewalPolicy {
 public:
  // `cost`: of a new matrix, in iterations; see renewal_cost().
  explicit RenewalPolicy(double cost) : cost_(cost) {}

  // True if the next solve should begin with a new matrix.
  bool is_due() const { return forced_left_ > 0 || is_expensive_; }

  // Call it at a restart: the next renewal then does not count as a failure of the old matrix.
  void restart() { restarted_ = true; }

  // Call it after each solve of a step or stage. `iterations`: number of iterations of the solve; attempts that did not
  // converge count, too. `renewed`: whether the tangent was computed in the solve.
  void note(double iterations, bool renewed) {
    count_failure(renewed && !is_due() && !restarted_, renewed);
    restarted_ = false;
    if (renewed) {
      total_ = cost_;
      solves_ = 0;
    }
    total_ += iterations;
    ++solves_;
    is_expensive_ = iterations * solves_ > total_;
  }

 private:
  void count_failure(bool failed, bool renewed) {
    if (forced_left_ > 0) {
      --forced_left_;
    } else if (failed) {
      if (++failures_ < kFailures) return;
      forced_left_ = forced_next_;
      forced_next_ = std::min(2 * forced_next_, kMaxForced);
    } else if (!renewed) {
      failures_ = 0;
      forced_next_ = kMinForced;
    }
  }

  static constexpr int kFailures = 4;                    // in a row, before each solve gets a new matrix
  static constexpr int kMinForced = 4, kMaxForced = 64;  // solves until an old matrix is tried again
  double cost_;
  double total_ = 0;  // cost since the last renewal, in iterations
  int solves_ = 0;    // number of solves in this time
  bool is_expensive_ = false, restarted_ = true;
  int failures_ = 0;
  int forced_left_ = 0, forced_next_ = kMinForced;  // solves with a new matrix: remaining, and after the next failures
};

}  // namespace orthodyn
