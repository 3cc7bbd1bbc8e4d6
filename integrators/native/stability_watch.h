// Keeps the step of an explicit method of fixed step below its critical one while the stiffness changes.
//
// The critical step is computed anew after a number of steps, which grows by half as long as it has changed by
// less than 0.5 % in between and is halved where it has changed by more than 2 %: it costs a tangent and a few
// products. A model with constant stiffness is looked at once.
#pragma once

#include "integrators/critical_step.h"

namespace orthodyn {

class StabilityWatch {
 public:
  // Both must outlive this.
  StabilityWatch(const Model& model, Statistics& statistics)
      : constant_(model.traits().linear), critical_(model, statistics) {}

  // Looks now.
  void look(const State& state);

  // Counts a step. True if it is time to look.
  bool due() { return !constant_ && --left_ <= 0; }

  double critical() const { return step_; }
  bool expects_contact() const { return critical_.reserve() > 0; }

 private:
  bool constant_;
  CriticalStep critical_;
  double step_ = 0;
  int interval_ = 0, left_ = 0;  // steps
};

}  // namespace orthodyn
