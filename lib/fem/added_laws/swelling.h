// Swelling and thermal expansion: the stress-free strain e* = sum of theta diag(a1, a2, a3) along the material axes,
// for the changes theta of moisture and temperature (lib/element/swelling_law.h). The energy C:(e - e*) : (e - e*) / 2
// of strain e and e* is that of the elastic law, plus -C:e* : e + e*:C:e* / 2, which this law adds.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "lib/fem/added_laws/added_law.h"
#include "lib/fem/added_laws/point_values.h"
#include "lib/fem/terms/elasticity_options.h"

namespace orthodyn {

struct Swelling {
  std::string cause;                          // "moisture" or "temperature"
  Vec3 coefficients;                          // strain along the material axes per unit of change
  std::shared_ptr<const PointValues> change;  // per cent or K
};

// `stiffness`: of the elastic law, Pa, in material axes. `causes`: at least one.
std::unique_ptr<AddedLaw> make_swelling(const Mat6& stiffness, Kinematics kinematics, std::vector<Swelling> causes);

}  // namespace orthodyn
