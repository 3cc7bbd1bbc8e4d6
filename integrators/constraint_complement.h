// Linear systems of implicit schemes with constraints, by the Schur complement of the scheme's matrix A:
//
//     A x + G^T lambda = b,   G x = c:      S lambda = G x0 - c,   x = x0 - A^-1 G^T lambda,
//
// with x0 = A^-1 b and S = G A^-1 G^T. A keeps its size and its Cholesky factor; each factorisation solves one more
// system for each constraint. Not thread-safe: one object per integrator.
#pragma once

#include <Eigen/Cholesky>
#include <functional>

#include "lib/ode/constraints.h"

namespace orthodyn {

class ConstraintComplement {
 public:
  // `constraints` must outlive this object.
  explicit ConstraintComplement(const Constraints& constraints) : constraints_(constraints) {}

  const Constraints& constraints() const { return constraints_; }

  // Computes G at a state.
  void linearize(double t, const ConstVectorRef& q) { G_ = constraints_.jacobian(t, q); }
  // Computes A^-1 G^T and S. solve(b, x): A x = b. False if S is not positive definite.
  bool factor(const std::function<void(const Vector& b, Vector& x)>& solve);

  // lambda from x0 and c.
  Vector multipliers(const ConstVectorRef& x0, const ConstVectorRef& c) const {
    return S_.solve(G_.transpose() * x0 - c);
  }
  // A^-1 G^T lambda.
  Vector change(const Vector& lambda) const { return Y_ * lambda; }
  // The least x in the norm of A with G x = c.
  Vector least_change(const ConstVectorRef& c) const { return Y_ * S_.solve(c); }
  // Removes from x, by the least change in the norm of A, what violates G x = 0.
  void remove_violation(VectorRef x) const { x -= least_change(G_.transpose() * x); }

  const Eigen::SparseMatrix<double>& jacobian() const { return G_; }  // G^T, n x m
  const Eigen::MatrixXd& directions() const { return Y_; }            // A^-1 G^T, n x m
  std::size_t bytes() const;

 private:
  const Constraints& constraints_;
  Eigen::SparseMatrix<double> G_;  // G^T
  Eigen::MatrixXd Y_;              // A^-1 G^T
  Eigen::LLT<Eigen::MatrixXd> S_;
};

}  // namespace orthodyn
