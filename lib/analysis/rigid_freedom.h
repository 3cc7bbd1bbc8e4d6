// Rigid motions of a body, or of a connected component of it, that neither clamps nor terms resist. A body with free
// rigid motions has no unique rest position.
//
// The clamps leave free those combinations of the six rigid motions that vanish at all clamped coordinates. Such a
// motion r is free if r^T K r = 0 to round-off, with the stiffness K in the rest shape at time t (s). All functions are
// collective.
#pragma once

#include <string>

#include "lib/fem/fem_model.h"

namespace orthodyn {

// Describes the first component that is free, such as "the body can be translated along x and rotated about x"; empty
// if all components are held.
std::string describe_rigid_freedom(const FemModel& model, double t);

// Number of free rigid motions of all components.
int count_rigid_freedom(const FemModel& model, double t);

}  // namespace orthodyn
