// Replaces the 2n x 2n linear systems of methods for y' = (v, M^-1 f), y = (q, v), by one n x n solve.
//
// With A = M + gamma D + gamma^2 K (gamma in s), the systems of CVODE, ARKODE, IDA and Rosenbrock methods for the
// correction dy = (dq, dv) reduce to
//
//     A dv = p - gamma K r_q,   dq = r_q + gamma dv.
//
// First-order form, (I - gamma J) dy = (r_q, r_v):                 p = M r_v.
// IDA, (dF/dy + cj dF/dy') dy = (b_q, b_v) with gamma = 1/cj:      r_q = gamma b_q, p = gamma b_v.
// Here F = (q' - v, M v' - f).
//
// dq is computed from dv. Computing dv from dq would lose digits by cancellation if gamma is small.
#pragma once

#include "integrators/newton_matrix.h"

namespace orthodyn {

class ReducedSolve : public NewtonMatrix {
 public:
  // Throws ConfigError if the solver does not accept the model's matrices. `model` and `statistics`
  // must outlive this object.
  ReducedSolve(const Model& model, const SolverChoice& solver, TangentKind tangent, Statistics& statistics)
      : NewtonMatrix(model, solver, tangent, statistics), work_(model.num_dofs()) {}

  // Factors A; call linearize() first. False if A is singular or indefinite; a smaller gamma may help.
  bool factor(double gamma) { return NewtonMatrix::factor({1, gamma, gamma * gamma}); }

  // Solves as above with the gamma of the last factor(), which must have returned true. SUNDIALS expects a direct
  // solver to use this gamma, and scales the correction itself if gamma has changed since. r_q and dq may be the same
  // vector; so may p and dv.
  void solve(const ConstVectorRef& r_q, const ConstVectorRef& p, VectorRef dq, VectorRef dv) {
    multiply_stiffness(r_q, work_);
    work_ = p - gamma() * work_;
    NewtonMatrix::solve(work_, dv);
    dq = r_q + gamma() * dv;
  }

  double gamma() const { return weights().damping; }  // gamma of the last factor(), s

  std::size_t bytes() const { return NewtonMatrix::bytes() + static_cast<std::size_t>(work_.size()) * sizeof(double); }

 private:
  Vector work_;
};

}  // namespace orthodyn
