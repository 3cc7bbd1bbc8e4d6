// The part of Newton's systems that belongs to constraints, for IDA on the stabilised equations of index 2
//
//     q' = v - G^T mu,   M v' = f - G^T lambda,   dg/dt(t, q, v) = 0,   g(t, q) = 0.
//
// Source: Gear, Gupta & Leimkuhler, J. Comput. Appl. Math. 12/13, 1985. The exact motion has mu = 0.
//
// Newton's system has the rows cj dq - dv + G^T dmu = b_q, (cj M + D) dv + K dq + G^T dlambda = b_v, G dv = b_1 and
// G dq = b_2; derivatives of G are left out, as steps that resolve the motion make them small. With gamma = 1/cj,
// A = M + gamma D + gamma^2 K, H = G G^T and S = G A^-1 G^T,
//
//     H dmu = b_1 + G b_q - b_2 / gamma,   r_q = gamma (b_q - G^T dmu),
//     A dv0 = gamma (b_v - K r_q),   S (gamma dlambda) = G dv0 - b_1,
//     dv = dv0 - A^-1 G^T (gamma dlambda),   dq = r_q + gamma dv.
//
// See lib/ode/constraints_at.h for the second and third line.
//
// For CVODE on the equations of index 1, q' = v, M v' = f - G^T lambda, G v' + c = 0 with c from v (constraints.h),
// Newton's system is that of reduced_solve.h with G^T (gamma dlambda) added to the left side, and G dv = G r_v: after()
// with b_1 = G r_v, without mu and before().
#pragma once

#include <Eigen/Cholesky>
#include <optional>

#include "lib/ode/constraints_at.h"

namespace orthodyn::sundials {

class ConstraintSolve {
 public:
  // `constraints` must outlive this object.
  explicit ConstraintSolve(const Constraints& constraints) : constraints_(constraints) {}

  // Sets the state at which factor() computes G.
  void linearize(double t, const ConstVectorRef& q) {
    t_ = t;
    q_ = q;
  }
  // Factors H and S; solve(b, x): A x = b. False if S is not positive definite. The other functions use the results.
  bool factor(const ConstraintsAt::Solve& solve);

  // dmu, and r_q in place of gamma b_q.
  void before(double gamma, const ConstVectorRef& b_1, const ConstVectorRef& b_2, VectorRef r_q, VectorRef dmu) const;
  // G x.
  Vector product(const ConstVectorRef& x) const { return at_->jacobian().transpose() * x; }
  // dlambda, and dv and dq in place of dv0 and r_q + gamma dv0.
  void after(double gamma, const ConstVectorRef& b_1, VectorRef dq, VectorRef dv, VectorRef dlambda) const;

  const Eigen::MatrixXd& directions() const { return at_->directions(); }  // A^-1 G^T, n x m

 private:
  const Constraints& constraints_;
  double t_ = 0;
  Vector q_;
  std::optional<ConstraintsAt> at_;
  Eigen::LDLT<Eigen::MatrixXd> H_;
};

}  // namespace orthodyn::sundials
