// One symmetric n x n solve in place of SUNDIALS' 2n x 2n Newton system.
//
// With y = (q, v) and A = M + gamma D + gamma^2 K, both Newton systems reduce to
//     A dv = p - gamma K r_q,   dq = r_q + gamma dv:
//   CVODE, (I - gamma J) dy = r:                       p = M r_v;
//   IDA, (dF/dy + cj dF/dy') dy = b, gamma = 1/cj:     r_q = gamma b_q, p = gamma b_v.
// dq is found from dv, not dv from dq: the latter cancels for small gamma.
//
// When the exact tangent makes A indefinite, K is rebuilt from the Gauss-Newton part, which is
// positive semidefinite, and stays so for the next few set-ups.
#pragma once

#include <memory>
#include <string>

#include "lib/linear/solver.h"
#include "lib/ode/model.h"
#include "lib/ode/statistics.h"

namespace orthodyn::sundials {

class ReducedSolve {
 public:
  // Throws ConfigError if the solver does not take the model's matrices. `model` and `statistics`
  // must outlive this.
  ReducedSolve(const Model& model, const std::string& solver, TangentKind tangent, Statistics& statistics);

  // K and D at a state; factor() then may be called for any gamma.
  void linearize(double t, const ConstVectorRef& q, const ConstVectorRef& v);

  // False if no factor could be had: a smaller gamma may help.
  bool factor(double gamma);

  // Solves as above with the gamma of the last factor(): what SUNDIALS expects of a direct solver, whose
  // corrections it scales itself when gamma has moved on. r_q and dq, p and dv may be the same.
  void solve(const ConstVectorRef& r_q, const ConstVectorRef& p, VectorRef dq, VectorRef dv);

  std::size_t factor_bytes() const { return solver_->factor_bytes(); }
  std::size_t bytes() const;
  std::string description() const { return solver_->description(); }

 private:
  void assemble(TangentKind kind);
  FactorStatus try_factor(double gamma);

  const Model& model_;
  Statistics& statistics_;
  std::unique_ptr<LinearSolver> solver_;
  TangentKind tangent_;
  int gauss_newton_left_ = 0;  // set-ups for which the Gauss-Newton part is used
  State at_;                   // where K and D were taken
  Linearization linearization_;
  std::vector<double> values_;  // of A
  Vector work_;
  double gamma_ = 0;
};

}  // namespace orthodyn::sundials
