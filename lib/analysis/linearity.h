// How far linear kinematics are off at a displacement: the body with the exact force is brought to the equilibrium
// under what the linear one carries there, by Newton's method with the factorised K of the linear model. It knows
// rotations, strains and stretched midlines alike, and costs a few forces and solutions.
#pragma once

#include <memory>
#include <vector>

#include "lib/fem/fem_model.h"
#include "lib/linear/solver.h"

namespace orthodyn {

// Of a displacement, in the mass norm. Infinite where the iteration finds no equilibrium, as where a slender body has
// moved by a good part of its thickness.
struct LinearityError {
  double displacement = 0;  // by which the displacement would differ
  double stiffness = 0;     // the part of that along the displacement: how much softer or stiffer it is
};

class Linearity {
 public:
  // Models of one scene with linear and with exact kinematics, which must outlive it. `span`, s: of the motion, in
  // which a body that nothing holds can go so far; infinite in statics. Throws RunError if K cannot be factorised.
  Linearity(const FemModel& linear, const FemModel& exact, double span);

  // Of the displacement q at time t; 0 at rest.
  LinearityError error(double t, const Vector& q) const;

 private:
  const FemModel &linear_, &exact_;
  std::vector<double> values_;  // of K + M/span^2
  std::unique_ptr<LinearSolver> solver_;
};

}  // namespace orthodyn
