// Decides how often CVODE renews Newton's matrix. Keeping the matrix of an earlier step saves a tangent and a
// factorisation if the motion has changed the matrix little. Otherwise iterations are wasted before a new matrix is
// made. After repeated failures, as in large rotations, every step therefore gets a new matrix; after 4 to 64 such
// steps an old matrix is tried again.
#pragma once

#include <algorithm>

namespace orthodyn::sundials {

class SetupSchedule {
 public:
  // Largest number of steps between two set-ups, to be set before the next step.
  long interval() const { return forced_left_ > 0 ? 1 : kUsual; }

  // Records a step; `renewed`: K was recomputed in it.
  void note(bool renewed) {
    if (forced_left_ > 0) {
      --forced_left_;
    } else if (!renewed) {
      failures_ = 0;
      forced_next_ = kMinForced;
    } else if (++failures_ >= kFailures) {
      forced_left_ = forced_next_;
      forced_next_ = std::min(2 * forced_next_, kMaxForced);
    }
  }

 private:
  static constexpr long kUsual = 20;   // CVODE's default
  static constexpr int kFailures = 4;  // renewals in successive steps after which every step gets a new matrix
  static constexpr int kMinForced = 4, kMaxForced = 64;  // steps until an old matrix is tried again
  int failures_ = 0;
  int forced_left_ = 0, forced_next_ = kMinForced;  // steps with a new matrix: remaining, and after the next failures
};

}  // namespace orthodyn::sundials
