// The projection of a state onto g(t, q) = 0 and dg/dt(t, q, v) = 0, for CVODE. CVODE integrates the equations of index
// 1, M a = f - G^T lambda and G a + c = 0 (constraints.h), whose solutions drift away from the constraints; the
// projection after each step does not lower the order (Eich 1993, SIAM J. Numer. Anal. 30; Hairer & Wanner 1996,
// VII.2).
//
// Changes have the directions A^-1 G^T, where A = M + gamma D + gamma^2 K is Newton's matrix. With directions M^-1 G^T,
// a change would deform stiff bodies at their joints, and elastic forces would lose their accuracy.
#pragma once

#include "integrators/scaled_norm.h"
#include "lib/ode/constraints.h"

namespace orthodyn::sundials {

struct Projection {
  const Constraints& constraints;
  const Eigen::MatrixXd& directions;  // A^-1 G^T at a state nearby, n x m
  ScaledNorm norm;                    // of the error test
  double tolerance;                   // of positions and velocities, in this norm

  // Computes the changes that put q and v on the constraints at t. Throws RecoverableError if Newton's method does not
  // converge.
  void operator()(double t, const ConstVectorRef& q, const ConstVectorRef& v, VectorRef dq, VectorRef dv) const;
};

}  // namespace orthodyn::sundials
