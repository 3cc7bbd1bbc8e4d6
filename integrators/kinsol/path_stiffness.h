// The stiffness K on a path of equilibria, and its factor. K is exact, has predicted stresses
// (Model::linearize_predicted), or is positive semidefinite. If the chosen solver does not converge or finds K
// indefinite, as happens past a limit point, an L D L^T solver replaces it. Not thread-safe.
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
  // Throws ConfigError if the solver does not accept the model's matrices. `model` and `statistics` must outlive this
  // object.
  PathStiffness(const Model& model, const SolverChoice& solver, Statistics& statistics);

  // Set K at q (m) and load factor lambda. linearize_predicted() also uses the previous iterate (q_before,
  // lambda_before). Both throw the model's RecoverableError.
  void linearize(double lambda, const ConstVectorRef& q, TangentKind kind);
  void linearize_predicted(double lambda_before, const ConstVectorRef& q_before, double lambda,
                           const ConstVectorRef& q);

  // Factors K. False if K is singular. Throws RunError if memory is short.
  bool factor();
  // As factor(), but a symmetric K is factored by L D L^T if the chosen solver is direct and would not notice negative
  // eigenvalues.
  bool factor_with_inertia();

  // Number of negative eigenvalues of the last factored K; for an unsymmetric K, 1 if this number is odd and 0 if it is
  // even. Empty if unknown.
  std::optional<int> negative_eigenvalues() const { return negative_; }

  // Solves K x = b. Throws RecoverableError if an iterative solver does not converge and L D L^T fails, too.
  // Precondition: the last factor() returned true.
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
  bool iteration_failed_ = false;  // failed on a definite K; L D L^T is used from then on
  std::optional<int> negative_;
  LinearSolver* used_ = nullptr;  // holds the last factor
  Vector q_;                      // position at which K was computed
  Linearization linearization_;
  std::vector<double> values_;
};

}  // namespace orthodyn
