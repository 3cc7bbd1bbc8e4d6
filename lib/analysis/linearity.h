// How far linear kinematics are off at a displacement: the body with the exact force is brought to the equilibrium
// under what the linear one carries there, by Newton's method with the factorised tangent of the model. It knows
// rotations, strains and stretched midlines alike, and costs a few forces and solutions. In statics a tangent with the
// exact force and its factor are added: a straight column that carries more than Euler's load is at an equilibrium, but
// at none that lasts.
#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <vector>

#include "lib/fem/fem_model.h"
#include "lib/linear/solver.h"

namespace orthodyn {

// Of a displacement, in the mass norm. Infinite where the iteration finds no equilibrium, as where a slender body has
// moved by a good part of its thickness.
struct LinearityError {
  double displacement = 0;  // by which the displacement would differ
  double stiffness = 0;     // the part of that along the displacement: how much softer or stiffer it is
  bool unstable = false;    // in statics: an equilibrium of the exact force that does not last; both are infinite
};

// Of a vibration: how fast the exact force makes it part from the linear one, in the mass norm, sqrt(kg) m/s, and the
// decay of free vibrations of that shape by the model's damping, 1/s.
struct VibrationDrift {
  double rate = 0, decay = 0;

  // What has accumulated after `duration` (s), sqrt(kg) m: the solution of e' + decay e = rate with e(0) = 0.
  double after(double duration) const;
};

class Linearity {
 public:
  using Terms = std::vector<std::size_t>;  // indices of FemModel::Parts::elastic

  // Of these terms of a model, which must outlive it; they have linear kinematics. `span`, s: of the motion, in which a
  // body that nothing holds can go so far; infinite in statics. Throws RunError if the tangent at rest cannot be
  // factorised.
  Linearity(const FemModel& model, Terms terms, double span);

  // Of the displacement q at time t, by all terms or by some of them; 0 at rest.
  LinearityError error(double t, const Vector& q) { return error(t, q, terms_); }
  LinearityError error(double t, const Vector& q, const Terms& terms);

  // Of a vibration of frequency omega, rad/s, about `mean` that swings by `swing` to both sides; see PhaseError for the
  // formula. The rate is infinite where no equilibrium is found.
  VibrationDrift drift(double t, const Vector& mean, const Vector& swing, double omega);

 private:
  bool factor(double t, const Vector& q, TangentKind kind);
  bool factor_for(double t, const Vector& q);  // as error() needs it
  // The tangent of the body with the exact force; false where it is not positive definite: at an equilibrium the body
  // is unstable there.
  bool factor_exact(double t, const Vector& q, const Terms& terms);
  LinearityError distance(double t, const Vector& q, const Terms& terms);  // to the equilibrium with the exact force
  // The displacement to it from q; none where it is not found.
  std::optional<Vector> shift(double t, const Vector& q, const Terms& terms);
  // What the exact force adds to that of the model, on the free coordinates.
  void add_correction(double t, const Vector& q, const Terms& terms, Vector& f) const;

  const FemModel& model_;
  Terms terms_;
  std::vector<std::unique_ptr<ElasticTerm>> exact_;  // of each of the model's elastic terms; null where not asked for
  double mass_;                                      // weight of the mass beside the stiffness, 1/s^2
  Linearization tangent_;
  std::vector<double> values_;
  std::unique_ptr<LinearSolver> solver_;
  bool holds_rest_ = false;  // the solver the factor of the tangent at rest
};

}  // namespace orthodyn
