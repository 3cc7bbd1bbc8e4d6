// Accelerations and multipliers of the equations of index 1, M a = f - G^T lambda and G a + c = 0 (constraints.h), at
// one state after another.
//
// With a lumped mass or few constraints, G M^-1 G^T is factored for each state, which takes one solve with M for each
// constraint. Otherwise conjugate gradients solve for lambda, with the factor at an earlier state as preconditioner:
// one solve with M for each iteration, of which nearby states take few. Not thread-safe: one object per integrator.
#pragma once

#include <Eigen/Cholesky>

#include "lib/ode/model.h"

namespace orthodyn::sundials {

class ConstraintForces {
 public:
  // `model` must outlive this object.
  explicit ConstraintForces(const Model& model) : model_(model) {}

  // The multipliers. `a`: accelerations by all other forces; becomes those with the forces of the constraints.
  // Precondition: the model has constraints.
  Vector multipliers(double t, const ConstVectorRef& q, const ConstVectorRef& v, VectorRef a);

 private:
  const Model& model_;
  Eigen::LDLT<Eigen::MatrixXd> H_;  // G M^-1 G^T at an earlier state; empty before the first one
};

}  // namespace orthodyn::sundials
