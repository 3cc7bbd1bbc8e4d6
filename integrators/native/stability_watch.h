// Tells an explicit method of fixed step its critical step while the stiffness changes.
//
// The critical step is computed anew after a number of steps, which grows by half as long as it has changed by less
// than 0.5 % in between and is halved where it has changed by more than 2 %: it costs a tangent and a few products. For
// a model with constant stiffness it is computed once. Not thread-safe: one per integrator.
#pragma once

#include "integrators/critical_step.h"

namespace orthodyn {

class StabilityWatch {
 public:
  // Both must outlive this.
  StabilityWatch(const Model& model, Statistics& statistics)
      : constant_(model.traits().linear), critical_(model, statistics) {}

  // Computes the critical step at a state. Throws RecoverableError where the model does.
  void update(const State& state);

  // Counts a step. True if it is time to update.
  bool due() { return !constant_ && --left_ <= 0; }

  // s, of the last update; infinite where nothing resists.
  double critical() const { return step_; }
  bool expects_contact() const { return critical_.reserve() > 0; }

 private:
  bool constant_;
  CriticalStep critical_;
  double step_ = 0;
  int interval_ = 0, left_ = 0;  // steps
};

}  // namespace orthodyn
