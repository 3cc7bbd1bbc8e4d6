// The constraints of a model (constraints.h) at given positions, and the directions A^-1 G^T in which their forces move
// the model. A is the mass matrix, or the matrix of an implicit scheme. With S = G A^-1 G^T,
//
//     A x + G^T lambda = b,   G x = c:      S lambda = G x0 - c,   x = x0 - A^-1 G^T lambda,   x0 = A^-1 b.
//
// A keeps its size and its Cholesky factor; each A takes one more solution for each constraint.
#pragma once

#include <Eigen/Cholesky>
#include <functional>

#include "lib/ode/constraints.h"

namespace orthodyn {

class Model;

class ConstraintsAt {
 public:
  // Solves A x = b.
  using Solve = std::function<void(const Vector& b, Vector& x)>;

  // With the mass matrix. `model` has constraints. Models and constraints must outlive this object.
  ConstraintsAt(const Model& model, double t, const Vector& q);
  ConstraintsAt(const Constraints& constraints, double t, const Vector& q, const Solve& solve);

  const Eigen::SparseMatrix<double>& jacobian() const { return G_; }  // G^T, n x m
  const Eigen::MatrixXd& directions() const { return W_; }            // n x m
  const Eigen::MatrixXd& matrix() const { return S_; }                // m x m
  // False if constraints depend on each other, or if A is not positive definite.
  bool is_definite() const { return factor_.info() == Eigen::Success && factor_.vectorD().minCoeff() > 0; }

  // lambda from x0 and c.
  Vector solve(const ConstVectorRef& x0, const ConstVectorRef& c) const {
    return factor_.solve(G_.transpose() * x0 - c);
  }
  // A^-1 G^T lambda.
  Vector change(const ConstVectorRef& lambda) const { return W_ * lambda; }
  // The least x in the norm of A with G x = c.
  Vector least_change(const ConstVectorRef& c) const { return W_ * factor_.solve(c); }
  // Removes from x, by the least change, what violates G x = 0.
  void remove_violation(VectorRef x) const { x -= least_change(G_.transpose() * x); }

  // Makes positions near q fit the constraints, to round-off.
  void fit_positions(VectorRef q) const;
  // Makes velocities fit the constraints, by the least change.
  void fit(VectorRef v) const;
  // The multipliers lambda of a motion with the velocities v; A is the mass matrix. `a`: accelerations by all other
  // forces; becomes those with the forces of the constraints.
  Vector multipliers(const ConstVectorRef& v, VectorRef a) const;

  std::size_t bytes() const;

 private:
  const Constraints& constraints_;
  double t_;
  Vector q_;
  Eigen::SparseMatrix<double> G_;  // G^T
  Eigen::MatrixXd W_, S_;          // A^-1 G^T, G A^-1 G^T
  Eigen::LDLT<Eigen::MatrixXd> factor_;
};

}  // namespace orthodyn
