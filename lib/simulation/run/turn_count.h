// Counts the turns of a model's angles (Model::angles()) over the steps of a run.
#pragma once

#include "lib/ode/model.h"

namespace orthodyn {

class TurnCount {
 public:
  // Begins at the angles of the state, or between -pi and pi if it has none. The model must outlive this object.
  TurnCount(const Model& model, const State& initial);

  bool empty() const { return end_.angles.size() == 0; }

  // Counts on to a state at the end of a step. A step turns by less than half a turn more or less than its velocities
  // at both ends tell.
  void advance(const State& end);

  // State::angles at a time of the last step.
  Vector at(double t) const;

 private:
  struct At {
    double t;
    Vector angles, rates;  // rad, rad/s
  };
  const Model& model_;
  At begin_, end_;
};

}  // namespace orthodyn
