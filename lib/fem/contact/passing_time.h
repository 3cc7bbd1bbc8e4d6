// How long two surfaces need to pass through each other.
#pragma once

#include "lib/fem/contact/contact_surface.h"

namespace orthodyn {

// The time (s) within which no part of one surface can be `depth` (m) behind the other one, from the positions x (m)
// and velocities v (m/s), if no velocity grows to more than four times the largest one under constant forces. Infinite
// if nothing moves. The surfaces may be the same one.
double passing_time(const ContactSurface& first, const ContactSurface& second, double depth, const NodalVector& x,
                    const NodalVector& v);

}  // namespace orthodyn
