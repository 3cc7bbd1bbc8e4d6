#include "integrators/sundials/constraint_forces.h"

#include "lib/ode/constraints.h"
#include "lib/ode/constraints_at.h"

namespace orthodyn::sundials {

namespace {
constexpr int kFew = 6;              // constraints that are always solved for directly
constexpr int kMostIterations = 8;   // after which the factor is renewed
constexpr double kResidual = 1e-12;  // of the accelerations along the constraints, in the norm of the kinetic energy
}  // namespace

Vector ConstraintForces::multipliers(double t, const ConstVectorRef& q, const ConstVectorRef& v, VectorRef a) {
  const Constraints& constraints = *model_.constraints();
  if (model_.traits().lumped_mass || constraints.size() <= kFew) return ConstraintsAt(model_, t, q).multipliers(v, a);

  const Eigen::SparseMatrix<double> G = constraints.jacobian(t, q);  // G^T
  Vector c(constraints.size());
  constraints.curvature(t, q, v, c);
  Vector lambda = Vector::Zero(c.size());
  if (H_.rows() > 0) {
    Vector residual = G.transpose() * a + c, z = H_.solve(residual), direction = z, w(a.size());
    double size = residual.dot(z);
    const double enough = kResidual * kResidual * size;
    for (int k = 0; k < kMostIterations && size > enough; ++k) {
      w = G * direction;
      model_.solve_mass(w);
      const Vector change = G.transpose() * w;
      const double step = size / direction.dot(change);
      lambda += step * direction;
      a -= step * w;
      residual -= step * change;
      z = H_.solve(residual);
      const double next = residual.dot(z);
      direction = z + next / size * direction;
      size = next;
    }
    if (size <= enough) return lambda;
  }
  const ConstraintsAt at(model_, t, q);
  H_.compute(at.matrix());
  return lambda + at.multipliers(v, a);
}

}  // namespace orthodyn::sundials
