// Swelling and thermal expansion: a stress-free strain e* (stress_free_strain.h; lib/element/swelling_law.h). The
// energy C:(e - e*) : (e - e*) / 2 of strain e and e* is that of the elastic law, plus -C:e* : e + e*:C:e* / 2, which
// this law adds.
#pragma once

#include <memory>
#include <vector>

#include "lib/fem/added_laws/added_law.h"
#include "lib/fem/added_laws/stress_free_strain.h"
#include "lib/fem/terms/elasticity_options.h"

namespace orthodyn {

// `stiffness`: of the elastic law, Pa, in material axes; of a viscoelastic material, the relaxed one (viscoelastic.h).
// `causes`: at least one.
std::unique_ptr<AddedLaw> make_swelling(const Mat6& stiffness, Kinematics kinematics, std::vector<Swelling> causes);

}  // namespace orthodyn
