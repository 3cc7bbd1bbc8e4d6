// Strengths of a material along its axes, and how near a stress comes to them.
//
// Exposures are homogeneous in the stress: 1 at failure, 0.5 under half of the stress that fails, so that 1/exposure is
// the factor by which the stress may still grow (the strength ratio). Stresses are in material axes, in the order 11,
// 22, 33, 12, 23, 31, Pa.
#pragma once

#include "lib/config/spec.h"

namespace orthodyn {

struct Strength {
  Vec3 tension = Vec3::Zero(), compression = Vec3::Zero();  // along 1, 2, 3
  Vec3 shear = Vec3::Zero();                                // of the planes 1-2, 2-3, 3-1
  static const Spec<Strength>& spec();
};

// Of a material without directions.
struct UniformStrength {
  double tension = 0, compression = 0, shear = 0;
  static const Spec<UniformStrength>& spec();
  Strength everywhere() const { return {Vec3::Constant(tension), Vec3::Constant(compression), Vec3::Constant(shear)}; }
};

// The largest ratio of a component to its strength.
double max_stress_exposure(const Vec6& stress, const Strength& strength);

// Tsai & Wu, J. Compos. Mater. 5 (1971): F_i s_i + F_ij s_i s_j = 1 at failure, with F_ij = -sqrt(F_ii F_jj)/2 for
// normal stresses i != j.
double tsai_wu_exposure(const Vec6& stress, const Strength& strength);

// Hashin, J. Appl. Mech. 47 (1980), in three dimensions, the largest of its modes: fibre (axis 1) and matrix (axes 2,
// 3) in tension and compression. It takes the strengths of axis 2 and of the planes 1-2 and 2-3.
double hashin_exposure(const Vec6& stress, const Strength& strength);

}  // namespace orthodyn
