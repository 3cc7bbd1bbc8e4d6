#include "integrators/sundials/constraint_projection.h"

#include <Eigen/LU>

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

void Projection::operator()(double t, const ConstVectorRef& q, const ConstVectorRef& v, VectorRef dq,
                            VectorRef dv) const {
  const Eigen::SparseMatrix<double> G = constraints.jacobian(t, q);  // G^T
  const Eigen::PartialPivLU<Eigen::MatrixXd> S(G.transpose() * directions);
  const auto change = [&](const Vector& c) -> Vector { return directions * S.solve(c); };  // the x with G x = c
  Vector g(constraints.size());
  dq.setZero();
  dv.setZero();
  const auto change_positions = [&] {
    constraints.values(t, q + dq, g);
    const Vector step = change(g);
    dq -= step;
    return norm(step, 1, 0);
  };
  const auto change_velocities = [&] {
    constraints.rates(t, q + dq, v + dv, g);
    const Vector step = change(g);
    dv -= step;
    return norm(step, 0, 1);
  };
  iterate(change_positions, tolerance);
  iterate(change_velocities, tolerance);
}

}  // namespace orthodyn::sundials
