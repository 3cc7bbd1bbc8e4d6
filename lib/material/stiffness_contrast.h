// How much stiffer a material is in its stiffest strain than in its softest, which tells whether elements lock.
#pragma once

#include "lib/core/types.h"

namespace orthodyn {

struct StiffnessContrast {
  double ratio;     // of the extreme eigenvalues of C in Mandel's notation; (1 + nu) / (1 - 2 nu) if isotropic
  bool volumetric;  // whether the stiffest strain is nearly a change of volume alone
};

// `stiffness`: Voigt form (stiffness.h), Pa. Precondition: positive definite.
StiffnessContrast stiffness_contrast(const Mat6& stiffness);

// Whether elements of the displacement formulation have wrong stresses, so that the mixed one is needed.
bool is_nearly_incompressible(const Mat6& stiffness);

}  // namespace orthodyn
