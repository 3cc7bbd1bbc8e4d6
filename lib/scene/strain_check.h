// Warns where a scene may strain its materials beyond what the corotational law holds for
// (strain_limits.h): by twice the linear static response to its dead loads and gravity, which is what a
// suddenly applied load reaches, or by its initial deformation. What motion alone may do (initial velocity,
// resonance, impact) is not foreseen.
#pragma once

#include "lib/scene/build.h"
#include "lib/analysis/static_response.h"

namespace orthodyn {

// Whether there is anything to look at: corotational kinematics, and limits that a body may meet. Very
// large models are left out of what costs a factorisation.
bool needs_strain_check(const Scene& scene, const BuiltScene& built);

Warnings strain_warnings(const Scene& scene, const BuiltScene& built, const StaticResponse& statics);

}  // namespace orthodyn
