// Linear viscoelasticity of a material: a Prony series of its stiffness. After a sudden strain the stiffness is
//     C(t) = C - sum_i C_i (1 - exp(-t / tau_i)),   C_i = A_i C A_i,
// with the given stiffness C at t = 0 and A_i = diag(sqrt(share)) in Voigt form, so that each C_i is positive
// semidefinite. The relaxed stiffness C - sum_i C_i must be positive definite.
//
// For an isotropic material with different shares of shear and bulk, C_i = share_G C_G + share_K C_K with the
// deviatoric and the volumetric part of C.
#pragma once

#include <optional>
#include <vector>

#include "lib/config/spec.h"
#include "lib/material/stiffness.h"

namespace orthodyn {

struct PronyBranch {
  double time = 0;                         // s
  std::optional<double> share;             // of all constants
  std::optional<Vec3> normal;              // shares of the stiffness along the axes 1, 2, 3
  std::optional<Vec3> shear;               // shares of G12, G23, G31
  std::optional<double> deviatoric, bulk;  // shares of G and K of an isotropic material
  static const Spec<PronyBranch>& spec();

  Mat6 stiffness(const Mat6& C) const;  // C_i, Pa
};

using Viscoelasticity = std::vector<PronyBranch>;

// C minus the stiffness of all branches, Pa.
Mat6 relaxed_stiffness(const Viscoelasticity& branches, const Mat6& C);

// Whether a change of volume causes a stress that relaxes. Not with shares of shear moduli or `deviatoric` ones alone.
bool relaxes_in_volume(const Viscoelasticity& branches, const Mat6& C);

// Why the branches cannot be used with this stiffness, as a sentence; "" if they can.
std::string why_inadmissible(const Viscoelasticity& branches, const Stiffness& stiffness);

inline constexpr const char* kViscoelasticSentence =
    "Relaxation of the stiffness, which is that at once: a list of times with the shares that relax (Prony series).";

}  // namespace orthodyn
