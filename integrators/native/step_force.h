// The force of the energy-momentum method: at the middle (q, v) of a step from q0 the discrete gradient between q0
// and 2 q - q0, and the part of the model's force that depends on v.
#pragma once

#include "lib/ode/model.h"

namespace orthodyn {

class StepForce {
 public:
  // Throws ConfigError if the model has no discrete gradient. `model` must outlive this.
  explicit StepForce(const Model& model);

  // The step goes from q0 at t0 to t0 + h.
  void begin(double t0, const ConstVectorRef& q0, double h);

  // N. Throws RecoverableError where it cannot be evaluated.
  void force(double t, const ConstVectorRef& q, const ConstVectorRef& v, VectorRef f) const;

 private:
  const Model& model_;
  const DiscreteGradient& gradient_;
  Vector zero_, q0_;
  double t0_ = 0, h_ = 0;
};

}  // namespace orthodyn
