// Linear buckling: the load factors at which the equilibrium of a body that carries its loads becomes unstable, as its
// state without loads foretells them:
//
//     K phi = -lambda K' phi,
//
// with the stiffness K of the structure (the body, its springs and the ground, under their own forces alone), and K'
// the stiffness that the loads add: the stress stiffness of the stresses that they cause (static response u = K^-1 f),
// and their own where they follow the body (pressure; of an unsymmetric one the symmetric part). That the shape changes
// before it buckles is left out, as in the classic analysis (Cook et al., Concepts and Applications of Finite Element
// Analysis, 2002, 18.5): right where the body moves little until then, else follow the path
// (lib/statics/load_stepper.h).
#pragma once

#include <vector>

#include "lib/fem/fem_model.h"

namespace orthodyn {

struct BucklingMode {
  double load_factor = 0;  // of the loads at the time asked for
  Vector shape;            // phi . K phi = 1
  double residual = 0;     // |phi + lambda K^-1 K' phi| in the norm of K
};

struct BucklingModes {
  std::vector<BucklingMode> modes;  // of the lowest positive load factors, ascending
  // The load factor at which linear statics reach a strain of a tenth: higher ones are no buckling loads, and left out.
  double limit = 0;
};

// At most `count`, for the loads at time t, s; for the loads reversed no factor is told. unloaded: the free
// displacements with which the body rests without loads, m. Throws ConfigError for an unsymmetric tangent, RunError if
// the model is not held or they cannot be found.
BucklingModes buckling_modes(const FemModel& model, const Vector& unloaded, double t, int count);

}  // namespace orthodyn
