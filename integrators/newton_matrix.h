// The symmetric n x n matrix of every implicit scheme, A = w_m M + w_d D + w_k K, and its factor.
//
// When the exact tangent makes A indefinite, K is rebuilt from the Gauss-Newton part, which is
// positive semidefinite, and stays so for the next ten set-ups. Weights: w_m is 1, w_d in s, w_k in s^2 for the schemes
// of second order. Not thread-safe: one per integrator.
#pragma once

#include <memory>
#include <string>

#include "lib/core/solver_choice.h"
#include "lib/linear/solver.h"
#include "lib/ode/model.h"
#include "lib/ode/statistics.h"

namespace orthodyn {

class NewtonMatrix {
 public:
  // Throws ConfigError if the solver does not take the model's matrices. `model` and `statistics`
  // must outlive this.
  NewtonMatrix(const Model& model, const SolverChoice& solver, TangentKind tangent, Statistics& statistics);

  // K and D at a state (t in s, q and v of num_dofs()); factor() then may be called for any weights. Throws
  // RecoverableError where the model does.
  void linearize(double t, const ConstVectorRef& q, const ConstVectorRef& v);

  // Precondition: linearize(). False if the matrix is singular or indefinite: a smaller step may help. Throws RunError
  // if memory does not suffice.
  bool factor(const Weights& weights);

  // x = A^-1 b, as good as an iterative solver's tolerance. b and x may be the same. Precondition: the last
  // factor() was true. Such a solver throws RecoverableError where it does not converge, or where it comes upon an
  // indefinite A; then the next set-ups are as above.
  void solve(const ConstVectorRef& b, VectorRef x);

  // Of the next solutions of an iterative solver; by default 1e-10.
  bool is_iterative() const { return solver_->is_iterative(); }
  void set_tolerance(const SolveTolerance& tolerance) { solver_->set_tolerance(tolerance); }
  // That of a correction of Newton's method: `absolute` is what it may be off by without being noticed. Below a share
  // of the correction itself the next one mends it (Dembo, Eisenstat & Steihaug, SIAM J. Numer. Anal. 19, 1982).
  // Corrections are known to shrink by least_rate() at best, whatever they did.
  double least_rate() const { return is_iterative() ? kNewtonForcing : 0; }
  void set_newton_tolerance(double absolute) { set_tolerance({kNewtonForcing, absolute}); }

  // y = K x
  void multiply_stiffness(const ConstVectorRef& x, VectorRef y) const;

  const Weights& weights() const { return weights_; }  // of the last factor()
  std::size_t factor_bytes() const { return solver_->factor_bytes(); }
  std::size_t bytes() const;
  std::string description() const { return solver_->description(); }

 private:
  static constexpr double kNewtonForcing = 1e-2;

  void assemble(TangentKind kind);
  FactorStatus try_factor();
  void turn_to_gauss_newton();

  const Model& model_;
  Statistics& statistics_;
  std::unique_ptr<LinearSolver> solver_;
  TangentKind tangent_;
  int gauss_newton_left_ = 0;  // set-ups for which the Gauss-Newton part is used
  State at_;                   // where K and D were taken
  Linearization linearization_;
  std::vector<double> values_;  // of A
  Weights weights_;
};

}  // namespace orthodyn
