// How long two surfaces need to pass through each other.
#pragma once

#include "lib/fem/contact/contact_surface.h"

namespace orthodyn {

// The time (s) within which no node of one surface, whose positions and velocities are x (m) and v (m/s), can be
// `depth` (m) behind the box around the other one, if no velocity grows to more than four times the largest one under
// constant forces. Infinite if nothing moves. The surfaces may be the same one.
double passing_time(const ContactSurface& first, const ContactSurface& second, double depth, const NodalVector& x,
                    const NodalVector& v);

}  // namespace orthodyn
