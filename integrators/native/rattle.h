// The constraints of central differences (lib/ode/constraints.h): RATTLE (Andersen, J. Comput. Phys. 52, 1983).
//
//   q1 = q + h v + h^2/2 (a - M^-1 G(q)^T mu),    g(t + h, q1) = 0,
//   v1 = v + h/2 (a - M^-1 G(q)^T mu) + h/2 (a1 - M^-1 G(q1)^T nu),    dg/dt(t + h, q1, v1) = 0,
//
// with accelerations a = M^-1 f. Order 2 in q, v and the multipliers. Symplectic as the method without constraints
// (Leimkuhler & Skeel 1994): the energy stays bounded. A step solves with M once for each constraint.
#pragma once

#include <optional>

#include "lib/ode/constraints_at.h"
#include "lib/ode/hermite.h"
#include "lib/ode/model.h"

namespace orthodyn {

class Rattle {
 public:
  // `model` has constraints and must outlive this object. `extent`: size of its bodies, m; 0 if unknown.
  Rattle(const Model& model, double extent) : model_(model), extent_(extent) {}

  // Makes v of an end of a step fit the constraints, and adds their forces to a. The next step begins there.
  void finish(StepEnd& end);
  // a (m/s^2) at this end, without the forces of the constraints.
  const Vector& free_acceleration() const { return free_; }
  // The change of q (m) by the forces -G^T mu at the begin of the step, which puts it on the constraints at t. Throws
  // RecoverableError if it is not found.
  Vector change(double t, const ConstVectorRef& q) const;

  std::size_t bytes() const { return at_ ? at_->bytes() : 0; }

 private:
  const Model& model_;
  double extent_;  // m
  std::optional<ConstraintsAt> at_;
  Vector free_;
};

}  // namespace orthodyn
