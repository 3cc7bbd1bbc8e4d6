// The projection of a state onto g(t, q) = 0 and dg/dt(t, q, v) = 0, for CVODE. CVODE integrates the equations of index
// 1, M a = f - G^T lambda and G a + c = 0 (constraints.h), whose solutions drift away from the constraints; the
// projection after each step does not lower the order (Eich 1993, SIAM J. Numer. Anal. 30; Hairer & Wanner 1996,
// VII.2).
//
// Changes have the directions A^-1 G^T, where A = M + gamma D + gamma^2 K is Newton's matrix. With directions M^-1 G^T,
// a change would deform stiff bodies at their joints, and elastic forces would lose their accuracy.
#pragma once

#include <Eigen/LU>

#include "integrators/scaled_norm.h"
#include "lib/ode/constraints.h"

namespace orthodyn::sundials {

class ConstraintProjection {
 public:
  // The constraints at (t, q). `directions`: A^-1 G^T at a state nearby, n x m. All references must outlive this
  // object.
  ConstraintProjection(const Constraints& constraints, double t, const ConstVectorRef& q,
                       const Eigen::MatrixXd& directions);

  // Computes the changes that put q and v on the constraints, with errors below `tolerance` in the norm of the error
  // test. Throws RecoverableError if Newton's method does not converge.
  void project(const ConstVectorRef& v, const ScaledNorm& norm, double tolerance, VectorRef dq, VectorRef dv) const;

 private:
  // The x with G x = c.
  Vector change(const ConstVectorRef& c) const { return directions_ * S_.solve(c); }

  const Constraints& constraints_;
  double t_;
  Vector q_;
  const Eigen::MatrixXd& directions_;
  Eigen::SparseMatrix<double> G_;  // G^T
  Eigen::PartialPivLU<Eigen::MatrixXd> S_;
};

}  // namespace orthodyn::sundials
