// Which rigid motions of a body, or of a part of it that hangs together, nothing holds: neither clamps nor terms
// that resist them. A body that has some is in no definite place at rest.
//
// The rigid motions that the clamps leave are the null space of the 6 motions at the clamped coordinates; of these
// the ones with a stiffness r' K r of nothing but round-off are free. Functions are collective.
#pragma once

#include <string>

#include "lib/fem/fem_model.h"

namespace orthodyn {

// "can be translated along x and rotated about x", of the first part found free; empty if all are held.
std::string describe_rigid_freedom(const FemModel& model, double t);

// How many there are, of all parts.
int count_rigid_freedom(const FemModel& model, double t);

}  // namespace orthodyn
