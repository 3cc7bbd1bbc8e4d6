// When Newton's matrix of a step is made anew beforehand. One of earlier steps saves a tangent and a factor where the
// motion changes it little. Where it does not serve, its iterations are lost before a new one is made after all: large
// rotations then take a new one at each step, and an old one is tried again now and then.
#pragma once

#include <algorithm>

namespace orthodyn::sundials {

class SetupSchedule {
 public:
  // The largest number of steps between two set-ups, for the next step.
  long interval() const { return forced_left_ > 0 ? 1 : kUsual; }

  // After a step, in which K was made anew or not.
  void note(bool renewed) {
    if (forced_left_ > 0) {
      --forced_left_;
    } else if (!renewed) {
      failures_ = 0;
      forced_next_ = kFewest;
    } else if (++failures_ >= kFailures) {
      forced_left_ = forced_next_;
      forced_next_ = std::min(2 * forced_next_, kMost);
    }
  }

 private:
  static constexpr long kUsual = 20;             // SUNDIALS' own
  static constexpr int kFailures = 4;            // in a row: an old matrix serves one step of five at best
  static constexpr int kFewest = 4, kMost = 64;  // steps until it is tried again
  int failures_ = 0;
  int forced_left_ = 0, forced_next_ = kFewest;  // steps with a new matrix each: still to come, and next time
};

}  // namespace orthodyn::sundials
