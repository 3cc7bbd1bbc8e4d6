#include "integrators/sundials/constraint_projection.h"

#include "lib/core/errors.h"

namespace orthodyn::sundials {

namespace {

// Newton's method with the derivatives at the start, which are accurate for small changes. change(): makes the next
// change and returns its norm.
template <class Change>
void iterate(Change change, double tolerance) {
  constexpr int kMost = 10;
  for (int k = 0; k < kMost; ++k)
    if (change() <= tolerance) return;
  throw RecoverableError("the projection onto the constraints does not converge");
}

}  // namespace

ConstraintProjection::ConstraintProjection(const Constraints& constraints, double t, const ConstVectorRef& q,
                                           const Eigen::MatrixXd& directions)
    : constraints_(constraints),
      t_(t),
      q_(q),
      directions_(directions),
      G_(constraints.jacobian(t, q)),
      S_(G_.transpose() * directions) {}

void ConstraintProjection::project(const ConstVectorRef& v, const ScaledNorm& norm, double tolerance, VectorRef dq,
                                   VectorRef dv) const {
  Vector g(constraints_.size());
  dq.setZero();
  dv.setZero();
  const auto change_positions = [&] {
    constraints_.values(t_, q_ + dq, g);
    const Vector step = change(g);
    dq -= step;
    return norm(step, 1, 0);
  };
  const auto change_velocities = [&] {
    constraints_.rates(t_, q_ + dq, v + dv, g);
    const Vector step = change(g);
    dv -= step;
    return norm(step, 0, 1);
  };
  iterate(change_positions, tolerance);
  iterate(change_velocities, tolerance);
}

}  // namespace orthodyn::sundials
