// K of a path of equilibria and its factor: exact, mixed (Model::linearize_mixed) or positive semidefinite. Where the
// solver asked for finds K indefinite, as past a limit point, or does not converge, L D L^T takes its place. Not
// thread-safe.
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "lib/linear/solver.h"
#include "lib/ode/model.h"
#include "lib/ode/statistics.h"

namespace orthodyn {

class PathStiffness {
 public:
  // Throws ConfigError if the solver does not take the model's matrices. `model` and `statistics` must outlive this.
  PathStiffness(const Model& model, const SolverChoice& solver, Statistics& statistics);

  // K at q, m, under load factor lambda. Throw RecoverableError where the model does.
  void exact(double lambda, const ConstVectorRef& q);
  void mixed(double lambda_before, const ConstVectorRef& q_before, double lambda, const ConstVectorRef& q);
  void semidefinite(double lambda, const ConstVectorRef& q);

  // False where K is singular. Throws RunError if memory does not suffice.
  bool factor();
  // The same with a solver that tells the negative eigenvalues.
  bool factor_with_inertia();

  // Of the last factor; of an unsymmetric K 1 if their number is odd, else 0. None where its solver does not tell.
  std::optional<int> negative_eigenvalues() const { return negative_; }

  // x = K^-1 b. Throws RecoverableError where an iterative solver does not converge. Precondition: the last factor()
  // was true.
  void solve(const ConstVectorRef& b, VectorRef x);

  std::size_t factor_bytes() const;
  std::string description() const;

 private:
  bool factor_general();
  bool factor_definite();
  bool factor_indefinite();

  const Model& model_;
  Statistics& statistics_;
  std::unique_ptr<LinearSolver> solver_, indefinite_;
  bool constant_is_factored_ = false;
  bool resists_iterations_ = false;  // a definite K did: the others are like it
  std::optional<int> negative_;
  LinearSolver* used_ = nullptr;  // holds the last factor
  Vector q_;                      // where K was taken
  Linearization linearization_;
  std::vector<double> values_;
};

}  // namespace orthodyn
