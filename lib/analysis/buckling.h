// Linear buckling analysis: computes, from the unloaded state alone, the load factors lambda at which the equilibrium
// becomes unstable,
//
//     K phi = -lambda K_g phi.
//
// K is the stiffness of the unloaded structure (body, springs, ground contact). K_g is the stiffness that the loads f
// add: the stress stiffness of the linear response u = K^-1 f, and the symmetric part of the load stiffness of follower
// pressure. The prebuckling deformation is neglected, as in the classic analysis (Cook et al., Concepts and
// Applications of Finite Element Analysis, 2002, 18.5). If this deformation is not small, follow the load path instead
// (lib/statics/load_stepper.h).
#pragma once

#include <vector>

#include "lib/fem/fem_model.h"

namespace orthodyn {

struct BucklingMode {
  double load_factor = 0;  // critical factor on the loads at the time of the analysis
  Vector shape;            // phi at the free coordinates, m; phi . K phi = 1 J
  double residual = 0;     // |phi + lambda K^-1 K_g phi| in the norm of K
};

struct BucklingModes {
  std::vector<BucklingMode> modes;  // those with the lowest positive load factors, ascending
  double limit = 0;  // load factor at which the linear response reaches 10 % strain; modes above it are left out
};

// Computes at most `count` modes for the loads at time t (s). Negative load factors are not computed. `unloaded`:
// displacements (m) of the free coordinates in equilibrium without loads. Throws ConfigError for an unsymmetric
// tangent; RunError if the body is not held or is unstable, if it has no loads, or if the iteration fails.
BucklingModes buckling_modes(const FemModel& model, const Vector& unloaded, double t, int count);

}  // namespace orthodyn
