// Linear viscoelasticity (lib/material/viscoelasticity.h) of the strain e = S - I, which turns with the material. With
// a strain z_i for each relaxation time, the energy
//     Psi = e:C:e / 2 - sum_i e:C_i:z_i + sum_i z_i:C_i:z_i / 2,   z_i' = (e - z_i) / tau_i,
// is e:(C - sum C_i):e / 2 + sum_i (e - z_i):C_i:(e - z_i) / 2. The elastic law has e:C:e / 2; this law adds the
// rest. Its stress is that of swelling (lib/element/swelling_law.h) for s = sum_i C_i:z_i. It dissipates
// (e - z_i):C_i:(e - z_i) / tau_i, which is never negative.
//
// In blended states (blend.h) the dissipation is that of states that are not blended.
#pragma once

#include <memory>

#include "lib/fem/added_laws/added_law.h"
#include "lib/fem/terms/elasticity_options.h"
#include "lib/material/viscoelasticity.h"

namespace orthodyn {

// `stiffness`: of the elastic law, at once, Pa, in material axes. `branches`: at least one.
std::unique_ptr<AddedLaw> make_viscoelastic(const Mat6& stiffness, Kinematics kinematics,
                                            const Viscoelasticity& branches);

}  // namespace orthodyn
