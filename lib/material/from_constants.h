// Materials from constants in hand, e.g. of a mesh file that brings its own, instead of from the input.
//
// Units: density kg/m^3, moduli Pa. Throw ConfigError where a number is not finite, a modulus or the
// density is not positive, or the set is not stable: the message says what is allowed, the caller adds
// the place.
#pragma once

#include <memory>

#include "lib/material/material.h"
#include "lib/material/orthotropy.h"

namespace orthodyn {

std::shared_ptr<const Material> make_isotropic(double density, double young, double nu);
std::shared_ptr<const Material> make_orthotropic(double density, const OrthotropicConstants& constants);

}  // namespace orthodyn
