// The discrete gradient of a finite element model: the sum of its terms' forces between two states, N. Throws
// RecoverableError where an element is inverted or flattened at one of them. Safe in any thread.
#pragma once

#include "lib/fem/fem_model.h"

namespace orthodyn {

class MeanForce : public DiscreteGradient {
 public:
  // `parts` must outlive this.
  explicit MeanForce(const FemModel::Parts& parts) : parts_(parts) {}
  void mean_force(double t0, const ConstVectorRef& q0, double t1, const ConstVectorRef& q1, const ConstVectorRef& v,
                  VectorRef f) const override;

 private:
  const FemModel::Parts& parts_;
};

}  // namespace orthodyn
