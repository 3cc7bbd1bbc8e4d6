// The n x n matrix of an implicit scheme, A = w_m M + w_d D + w_k K, and its factor. For schemes on the second-order
// form w_m = 1, w_d is in s and w_k in s^2.
//
// If A of a nonlinear model is found indefinite, the next ten calls of linearize() compute only the positive
// semidefinite Gauss-Newton part of K. If factor() finds A indefinite, it also replaces the present K by this part and
// factors A again. Not thread-safe: one object per integrator.
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
  // Throws ConfigError if the solver does not accept the model's matrices. `model` and `statistics` must outlive this
  // object.
  NewtonMatrix(const Model& model, const SolverChoice& solver, TangentKind tangent, Statistics& statistics);

  // Computes K and D at a state (t in s, q and v of size num_dofs()). factor() may then be called with any weights.
  // Throws the model's RecoverableError.
  void linearize(double t, const ConstVectorRef& q, const ConstVectorRef& v);

  // Factors A. Precondition: linearize() has been called. False if A is singular or indefinite; a smaller step may
  // help. Throws RunError if memory is short.
  bool factor(const Weights& weights);

  // Solves A x = b; an iterative solver solves to its tolerance. b and x may be the same. Precondition: the last
  // factor() returned true. An iterative solver throws RecoverableError if it does not converge or finds A indefinite.
  void solve(const ConstVectorRef& b, VectorRef x);

  // True if solve() is accurate to a tolerance only, not to round-off.
  bool is_iterative() const { return solver_->is_iterative(); }
  // Sets the tolerance of the next solves of an iterative solver; 1e-10 by default.
  void set_tolerance(const SolveTolerance& tolerance) { solver_->set_tolerance(tolerance); }
  // Smallest ratio of successive Newton corrections that is reliable after set_newton_tolerance(), which makes solves
  // inexact; 0 with a direct solver.
  double least_rate() const { return is_iterative() ? kNewtonForcing : 0; }
  // Sets the tolerance for corrections of Newton's method: a relative error of 1e-2 (forcing term) or an absolute error
  // of `absolute`, whichever is larger. The next correction removes that error (Dembo, Eisenstat & Steihaug, SIAM J.
  // Numer. Anal. 19, 1982). A direct solver may then use single precision. Two kinds of models are excepted: linear
  // ones, whose first correction is the solution, and free bodies, whose linear momentum is kept to round-off.
  void set_newton_tolerance(double absolute) {
    if (is_iterative() || !needs_exact_solutions_) set_tolerance({kNewtonForcing, absolute});
  }

  // Computes y = K x.
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
  bool needs_exact_solutions_;
  int gauss_newton_left_ = 0;  // number of further linearize() calls that use the Gauss-Newton part
  State at_;                   // at which K and D were computed
  Linearization linearization_;
  std::vector<double> values_;  // entries of A
  Weights weights_;
};

}  // namespace orthodyn
