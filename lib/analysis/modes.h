// Natural modes of a model about a state: K phi = omega^2 M phi with the exact K there, no damping.
//
// Shapes are M-orthonormal, so that with r a rigid translation along an axis Gamma = r' M phi is the participation
// factor and Gamma^2 the effective modal mass, kg; these of all modes add up to the mass of the free coordinates. The
// model's supports must be at rest at the state's time: they have no part in a mode, but with a consistent mass those
// that `motions` move share in Gamma what couples them with free nodes.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "lib/ode/model.h"

namespace orthodyn {

struct Mode {
  double lambda = 0;                  // omega^2, rad^2/s^2; negative where the state is unstable
  Vector shape;                       // M-orthonormal
  Vec3 participation = Vec3::Zero();  // sqrt(kg); zero if the model tells no momentum.linear
  double residual = 0;  // |K phi - lambda M phi| / |lambda_ref M phi|, lambda_ref of this or the lowest elastic mode

  double angular_frequency() const;  // rad/s; of an unstable mode its rate of growth, negative
  double frequency() const;          // Hz
  Vec3 effective_mass() const { return participation.cwiseAbs2(); }
};

struct Modes {
  std::vector<Mode> modes;  // ascending
  int zeros = 0;            // those that round-off does not tell from zero, rigid or not
  double resolution = 0;    // the frequency up to which it does not, Hz
  std::string solver = {};  // of the linear systems
};

// About a state under its loads; with a load factor of 0 about one without them, where they add no stiffness. Throws
// ConfigError if the model has fewer modes or an unsymmetric tangent, RunError if they cannot be found.
Modes natural_modes(const Model& model, const State& about, int count);

}  // namespace orthodyn
