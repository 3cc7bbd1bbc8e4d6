// The ratio of a material's largest to its smallest stiffness, which tells whether elements lock.
#pragma once

#include "lib/core/types.h"
#include "lib/material/stiffness.h"

namespace orthodyn {

struct StiffnessContrast {
  double ratio;     // of the extreme eigenvalues of C in Mandel's notation; (1 + nu) / (1 - 2 nu) if isotropic, nu >= 0
  bool volumetric;  // true if the stiffest strain is nearly a pure change of volume
};

// `stiffness`: Voigt form (stiffness.h), Pa. Precondition: positive definite.
StiffnessContrast stiffness_contrast(const Mat6& stiffness);

// True if volumetric, with a ratio at which the stresses of elements in the displacement formulation are wrong, and if
// the mixed formulation at least halves the contrast.
bool is_nearly_incompressible(const Stiffness& stiffness);

// The bulk modulus less a third of the smallest eigenvalue of C, Pa. Without it, C - k I (x) I is still positive
// definite. Isotropic: k is Lame's constant lambda, and the rest is 2 mu e, the stiffness for nu = 0.
double volumetric_modulus(const Stiffness& stiffness);

// The part of the bulk modulus (Pa) that exceeds twice the smallest eigenvalue of C: of an isotropic material, the part
// above that of nu = 0.385, at which elements do not lock.
double excess_bulk_modulus(const Stiffness& stiffness);

// The largest eigenvalue of C - kappa I (x) I (without_bulk()) over the smallest of C: the contrast that the mixed
// formulation leaves if it projects all of kappa, and at most 6 less than if it projects the excess.
double contrast_without_bulk(const Stiffness& stiffness);

}  // namespace orthodyn
