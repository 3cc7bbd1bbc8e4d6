// Strengths along the material axes, and failure criteria.
//
// The exposure of a stress is 1/R, where the strength ratio R is the factor by which the stress must grow to cause
// failure: the exposure is 1 at failure and 0.5 at half the failure stress. Stresses (Pa) are in material axes in the
// order 11, 22, 33, 12, 23, 31.
#pragma once

#include "lib/config/spec.h"

namespace orthodyn {

struct Strength {
  Vec3 tension = Vec3::Zero(), compression = Vec3::Zero();  // along 1, 2, 3
  Vec3 shear = Vec3::Zero();                                // in the planes 1-2, 2-3, 3-1
  static const Spec<Strength>& spec();
};

// Strengths of an isotropic material.
struct UniformStrength {
  double tension = 0, compression = 0, shear = 0;
  static const Spec<UniformStrength>& spec();
  Strength everywhere() const { return {Vec3::Constant(tension), Vec3::Constant(compression), Vec3::Constant(shear)}; }
};

// The largest ratio of a stress component to its strength.
double max_stress_exposure(const Vec6& stress, const Strength& strength);

// Tsai & Wu, J. Compos. Mater. 5 (1971): F_i s_i + F_ij s_i s_j = 1 at failure for stresses s_i, with F_i and F_ii from
// the strengths and F_ij = -sqrt(F_ii F_jj)/2 for normal stresses i != j.
double tsai_wu_exposure(const Vec6& stress, const Strength& strength);

// Hashin, J. Appl. Mech. 47 (1980), in three dimensions: the largest exposure of the modes fibre (axis 1) and matrix
// (axes 2, 3), each in tension and compression. Uses the strengths of axes 1 and 2 and of the planes 1-2 and 2-3.
double hashin_exposure(const Vec6& stress, const Strength& strength);

}  // namespace orthodyn
