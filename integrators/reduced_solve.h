// One symmetric n x n solve in place of the 2n x 2n system of y' = (v, M^-1 f).
//
// With y = (q, v) and A = M + gamma D + gamma^2 K, the systems of CVODE, ARKODE, IDA and of Rosenbrock
// methods reduce to
//     A dv = p - gamma K r_q,   dq = r_q + gamma dv:
//   (I - gamma J) dy = r:                               p = M r_v;
//   IDA, (dF/dy + cj dF/dy') dy = b, gamma = 1/cj:     r_q = gamma b_q, p = gamma b_v.
// dq is found from dv, not dv from dq: the latter cancels for small gamma.
#pragma once

#include "integrators/newton_matrix.h"

namespace orthodyn {

class ReducedSolve {
 public:
  // Throws ConfigError if the solver does not take the model's matrices. `model` and `statistics`
  // must outlive this.
  ReducedSolve(const Model& model, const SolverChoice& solver, TangentKind tangent, Statistics& statistics)
      : matrix_(model, solver, tangent, statistics), work_(model.num_dofs()) {}

  // K and D at a state; factor() then may be called for any gamma.
  void linearize(double t, const ConstVectorRef& q, const ConstVectorRef& v) { matrix_.linearize(t, q, v); }

  // False if no factor could be had: a smaller gamma may help.
  bool factor(double gamma) { return matrix_.factor({1, gamma, gamma * gamma}); }

  // Solves as above with the gamma of the last factor(): what SUNDIALS expects of a direct solver, whose
  // corrections it scales itself when gamma has moved on. r_q and dq, p and dv may be the same.
  void solve(const ConstVectorRef& r_q, const ConstVectorRef& p, VectorRef dq, VectorRef dv) {
    const double gamma = matrix_.weights().damping;
    matrix_.multiply_stiffness(r_q, work_);
    work_ = p - gamma * work_;
    matrix_.solve(work_, dv);
    dq = r_q + gamma * dv;
  }

  // As NewtonMatrix has them, of dv.
  bool is_iterative() const { return matrix_.is_iterative(); }
  double least_rate() const { return matrix_.least_rate(); }
  void set_newton_tolerance(double absolute) { matrix_.set_newton_tolerance(absolute); }
  double gamma() const { return matrix_.weights().damping; }  // of the last factor()

  std::size_t factor_bytes() const { return matrix_.factor_bytes(); }
  std::size_t bytes() const { return matrix_.bytes() + static_cast<std::size_t>(work_.size()) * sizeof(double); }
  std::string description() const { return matrix_.description(); }

 private:
  NewtonMatrix matrix_;
  Vector work_;
};

}  // namespace orthodyn
