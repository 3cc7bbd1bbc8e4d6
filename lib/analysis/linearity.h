// Error of linear kinematics at a displacement q. Newton's method, with the factorised tangent of the model, moves the
// body from q to the position at which the exact (corotational) force equals the linear force at q. The distance is the
// error. It includes the effects of rotations, finite strains and stretched midlines, and costs a few force evaluations
// and solves. In statics the tangent of the exact force is also factorised, because a straight column above Euler's
// load is in equilibrium, but unstable.
#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <vector>

#include "lib/fem/fem_model.h"
#include "lib/linear/solver.h"

namespace orthodyn {

// Error of a displacement in the mass norm. Both errors are infinite if the iteration finds no equilibrium, for example
// if a slender body has moved by a large part of its thickness.
struct LinearityError {
  double displacement = 0;  // |error| / |displacement|
  double stiffness = 0;     // |error along the displacement| / |displacement|: relative error of the stiffness
  bool unstable = false;    // statics only: the exact tangent is not positive definite; both errors are then infinite
};

// `rate`: how fast a vibration with the exact force departs from the linear vibration, in the mass norm (sqrt(kg) m/s).
// `decay`: rate (1/s) at which the model's damping reduces free vibrations of this shape.
struct VibrationDrift {
  double rate = 0, decay = 0;

  // Error after `duration` (s), in sqrt(kg) m: the solution e of de/dt + decay e = rate with e(0) = 0.
  double after(double duration) const;
};

class Linearity {
 public:
  using Terms = std::vector<std::size_t>;  // indices of FemModel::Parts::elastic

  // `terms`: terms with linear kinematics whose error is computed. The model must outlive this object. `span`: duration
  // of the motion (s), which limits how far an unsupported body drifts; infinite in statics. Throws RunError if the
  // tangent at rest cannot be factorised.
  Linearity(const FemModel& model, Terms terms, double span);

  // Error of the displacement q (m) at time t (s), caused by all terms of this object or by `terms`; 0 for q = 0.
  LinearityError error(double t, const Vector& q) { return error(t, q, terms_); }
  LinearityError error(double t, const Vector& q, const Terms& terms);

  // Drift of a vibration between mean - swing and mean + swing (m) with angular frequency omega (rad/s). The class
  // PhaseError explains the formula. The rate is infinite if no equilibrium is found.
  VibrationDrift drift(double t, const Vector& mean, const Vector& swing, double omega);

 private:
  bool factor(double t, const Vector& q, TangentKind kind);
  bool factor_for(double t, const Vector& q);  // factorises the tangent that shift() starts with
  // Factorises the tangent at q with the exact force of `terms`. Returns false if it is not positive definite; an
  // equilibrium at q is then unstable.
  bool factor_exact(double t, const Vector& q, const Terms& terms);
  // Computes the error from the distance between q and the equilibrium with the exact force.
  LinearityError distance(double t, const Vector& q, const Terms& terms);
  // Displacement (m) from q to the equilibrium with the exact force; nullopt if no equilibrium is found.
  std::optional<Vector> shift(double t, const Vector& q, const Terms& terms);
  // Adds the forces (N) or tangents of some elastic terms and of their added terms: `exact` ones or those of the model.
  void add_forces(bool exact, const Terms& terms, const NodalState& s, NodalVector& f) const;
  void add_tangents(bool exact, const Terms& terms, const NodalState& s, double* K) const;
  // Adds the exact minus the linear force (N) of the terms to f, on the free coordinates.
  void add_correction(double t, const Vector& q, const Terms& terms, Vector& f) const;

  const FemModel& model_;
  Terms terms_;
  // Parallel to Parts::elastic, empty for other terms: the terms with corotational kinematics, first the elastic one.
  std::vector<std::vector<std::unique_ptr<Term>>> exact_;
  double mass_;  // weight of M in the factorised matrix K + mass_ M, 1/s^2
  Linearization tangent_;
  std::vector<double> values_;
  std::unique_ptr<LinearSolver> solver_;
  bool holds_rest_ = false;  // whether the solver holds the factor of the tangent at rest
};

}  // namespace orthodyn
