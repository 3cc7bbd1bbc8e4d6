// How large motion and velocity will be, roughly: what error tolerances are relative to.
//
// Position: a tenth of the body's largest extent L; less if a body that starts at rest is known to
// move less: twice the linear static deflection u under the peak loads.
// Velocity: the largest of 10 omega times the position scale with omega^2 = u.f / u.M u (Rayleigh's
// quotient of that deflection), and 3 sqrt(2 E0 / m) with E0 the initial elastic and kinetic energy;
// for an unclamped body under load 3 sqrt(L |f| / m).
#pragma once

#include "lib/scene/build.h"

namespace orthodyn {

Scales estimate_scales(const Scene& scene, const BuiltScene& built);

}  // namespace orthodyn
