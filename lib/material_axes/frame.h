// Right-handed orthonormal frames: rotations whose columns are the directions 1, 2, 3.
#pragma once

#include <string>

#include "lib/core/types.h"

namespace orthodyn {

// Axis 1 along `first`, axis 2 along the part of `second` normal to it (Gram-Schmidt), axis 3 = 1 x 2. Precondition:
// are_independent(first, second): both are nonzero and not parallel. Their lengths do not matter.
Mat3 frame(const Vec3& first, const Vec3& second);
bool are_independent(const Vec3& first, const Vec3& second);

// An arbitrary unit vector normal to `direction`: the coordinate axis least aligned with it (the first of equal ones),
// projected normal to it.
Vec3 any_normal(const Vec3& direction);

// Reorders `directions`, orthonormal columns named by `letters` ("LRT"), to the order of `word` ("RTL"). The third
// column is set to 1 x 2, which may reverse it; orthotropy does not depend on its sign.
Mat3 in_order(const Mat3& directions, const std::string& letters, const std::string& word);

}  // namespace orthodyn
