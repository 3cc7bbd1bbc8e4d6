// Natural modes of a model about a state: K phi = omega^2 M phi with the exact K of that state, without damping.
//
// Shapes are M-orthonormal. For a rigid translation r along an axis, Gamma = r^T M phi is the participation factor and
// Gamma^2 the effective modal mass (kg). The effective masses of all modes add up to the mass of the free coordinates.
// Precondition: the model's supports are at rest at the state's time. With a consistent mass, Gamma includes the
// coupling of free nodes with nodes that `motions` move.
#pragma once

#include <string>
#include <vector>

#include "lib/ode/model.h"

namespace orthodyn {

struct Mode {
  double lambda = 0;                  // omega^2, rad^2/s^2; negative for an unstable mode
  Vector shape;                       // M-orthonormal
  Vec3 participation = Vec3::Zero();  // Gamma along x, y, z, sqrt(kg); zero without the output momentum.linear
  double residual = 0;  // |K phi - lambda M phi| / |lambda_ref M phi|, lambda_ref = max(|lambda|, lowest nonzero)

  double angular_frequency() const;  // rad/s; for an unstable mode, minus its growth rate
  double frequency() const;          // Hz
  Vec3 effective_mass() const { return participation.cwiseAbs2(); }
};

struct Modes {
  std::vector<Mode> modes;  // in ascending order of lambda
  int zeros = 0;            // modes with zero frequency to round-off, rigid or not
  double resolution = 0;    // Hz; lower frequencies count as zero
  std::string solver = {};  // name of the linear solver that was used
};

// Flips the shape if its largest entry is negative, so that the sign does not depend on the solver.
void fix_sign(Vector& shape);

// Computes the lowest `count` modes about a state under its loads. With about.load_factor == 0, the stiffness of the
// loads is left out. Throws ConfigError if the model has fewer than `count` modes or an unsymmetric tangent, RunError
// if the iteration fails.
Modes natural_modes(const Model& model, const State& about, int count);

// Computes all modes below a frequency (Hz), and at least one above it if the model has one. Throws as natural_modes(),
// and ConfigError if there are more than 2,000.
Modes natural_modes_below(const Model& model, const State& about, double frequency);

}  // namespace orthodyn
