// Right-handed orthonormal frames, as rotations whose columns are the directions 1, 2, 3.
#pragma once

#include <string>

#include "lib/core/types.h"

namespace orthodyn {

// Axis 1 along `first`, axis 2 the part of `second` normal to it (Gram-Schmidt), axis 3 = 1 x 2. The
// directions have any length, and are neither zero nor parallel (see are_independent()).
Mat3 frame(const Vec3& first, const Vec3& second);
bool are_independent(const Vec3& first, const Vec3& second);

// A unit vector normal to `direction`: the coordinate axis that is least along it (the first of equal
// ones), less its part along it. For where nothing else gives a direction.
Vec3 any_normal(const Vec3& direction);

// `directions` (orthonormal columns named by `letters`, say "LRT") in the order of `word`, say "RTL"; the
// third becomes 1 x 2, which may reverse it: orthotropy does not tell a direction from its opposite.
Mat3 in_order(const Mat3& directions, const std::string& letters, const std::string& word);

}  // namespace orthodyn
