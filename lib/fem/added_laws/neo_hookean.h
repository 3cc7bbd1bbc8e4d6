// The neo-Hookean law (lib/element/neo_hookean.h) in place of the corotational one, for large strains of rubber. The
// region's elastic term then serves for strains and axes only (ObservedElasticTerm).
#pragma once

#include <memory>

#include "lib/fem/added_laws/added_law.h"

namespace orthodyn {

// `beta`: stiffness-proportional damping, s; 0 for none.
std::unique_ptr<AddedLaw> make_neo_hookean(const IsotropicStiffness& stiffness, double beta);

}  // namespace orthodyn
