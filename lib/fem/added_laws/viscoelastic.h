// Linear viscoelasticity (lib/material/viscoelasticity.h) of the strain e = S - I, which turns with the material. With
// a strain y_i for each relaxation time, the energy
//     Psi = e:C:e / 2 - sum_i e:C_i:y_i + sum_i y_i:C_i:y_i / 2
// is e:(C - sum C_i):e / 2 + sum_i (e - y_i):C_i:(e - y_i) / 2. The elastic law has e:C:e / 2; this law adds the
// rest. Its stress is that of swelling (lib/element/swelling_law.h) for s = sum_i C_i:y_i. It dissipates
// (e - y_i):C_i:(e - y_i) / tau_i, which is never negative.
//
// y_i = z_i + e* with the internal variables z_i and the stress-free strain e*, which causes no stress that could
// relax:
//     z_i' = (e - e* - z_i) / tau_i.
// This law thus has the part of the swelling stress that can relax, sum C_i:e*. The swelling law (swelling.h) has the
// other part, (C - sum C_i):e*.
//
// In blended states (blend.h) the dissipation is that of states that are not blended.
#pragma once

#include <memory>
#include <vector>

#include "lib/fem/added_laws/added_law.h"
#include "lib/fem/added_laws/stress_free_strain.h"
#include "lib/fem/terms/elasticity_options.h"
#include "lib/material/viscoelasticity.h"

namespace orthodyn {

// `stiffness`: of the elastic law, at once, Pa, in material axes. `branches`: at least one. `causes` of e*: maybe none.
std::unique_ptr<AddedLaw> make_viscoelastic(const Mat6& stiffness, Kinematics kinematics,
                                            const Viscoelasticity& branches, std::vector<Swelling> causes);

}  // namespace orthodyn
