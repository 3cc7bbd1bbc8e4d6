// The constraints of a model (constraints.h) at given positions: consistent velocities and multipliers.
#pragma once

#include <Eigen/Cholesky>

#include "lib/ode/constraints.h"

namespace orthodyn {

class Model;

class ConstraintsAt {
 public:
  // `model` has constraints and must outlive this object.
  ConstraintsAt(const Model& model, double t, const Vector& q);

  // G M^-1 G^T, m x m.
  const Eigen::MatrixXd& matrix() const { return H_; }

  // Makes positions near q fit the constraints, to round-off, by a change along M^-1 G^T.
  void fit_positions(VectorRef q) const;
  // Makes velocities fit the constraints, by the least change in the norm of the kinetic energy.
  void fit(VectorRef v) const;
  // The multipliers lambda of a motion with the velocities v. `a`: accelerations by all other forces; becomes those
  // with the forces of the constraints.
  Vector multipliers(const ConstVectorRef& v, VectorRef a) const;

 private:
  const Constraints& constraints_;
  double t_;
  Vector q_;
  Eigen::SparseMatrix<double> G_;  // G^T
  Eigen::MatrixXd W_, H_;          // M^-1 G^T, G M^-1 G^T
  Eigen::LDLT<Eigen::MatrixXd> factor_;
};

}  // namespace orthodyn
