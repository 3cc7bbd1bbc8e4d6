// Warns where a corotational body may be strained beyond what the law holds for (strain_limits.h): by twice the linear
// static response to its dead loads and gravity, which is what a suddenly applied load reaches, or by its initial
// deformation. What motion alone may do (initial velocity, resonance, impact) is not foreseen.
#pragma once

#include <optional>
#include <string>
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

// Where a state is strained beyond a limit: the worst of all regions.
struct StrainExcess {
  double share = 0;      // of the strain, over the limit
  std::string sentence;  // "puts 3 of 400 elements along material axis 1 under ..."
};
std::optional<StrainExcess> strain_excess(const FemModel& model, const NodalState& state);

// Whether there is a limit that a body may meet, however large its model.
bool has_strain_limits(const FemModel& model);

}  // namespace orthodyn
