// Warns where a corotational body may be strained beyond what the law holds for (strain_limits.h): by twice the linear
// static response to its dead loads and gravity, which is what a suddenly applied load reaches, or by its initial
// deformation. What motion alone may do (initial velocity, resonance, impact) is not foreseen.
#pragma once

#include <vector>

#include "lib/analysis/static_response.h"
#include "lib/material/stiffness.h"

namespace orthodyn {

// `stiffness` is that of each elastic term of the model, in their order.
//
// Whether there is anything to check: limits that a body may meet. Very large models are left out of what costs a
// factorisation.
bool needs_strain_check(const FemModel& model, const std::vector<Stiffness>& stiffness);

Warnings strain_warnings(const FemModel& model, const std::vector<Stiffness>& stiffness, const State& initial,
                         const StaticResponse& statics);

}  // namespace orthodyn
