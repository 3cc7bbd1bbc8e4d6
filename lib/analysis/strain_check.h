// Warns if a corotational body may be strained beyond the limits of the law (strain_limits.h). Two strains are checked:
// those of twice the linear static response to the peak loads and gravity, which a suddenly applied load reaches, and
// those of the initial deformation. Strains that only the motion causes (initial velocity, resonance, impact) are not
// predicted.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "lib/analysis/static_response.h"

namespace orthodyn {

// Whether any region has a strain limit that a body can reach. False for models with more than 30,000 unknowns, for
// which the factorisation is too expensive.
bool needs_strain_check(const FemModel& model);

Warnings strain_warnings(const FemModel& model, const State& initial, const StaticResponse& statics);

// The region that exceeds its strain limit most in a state.
struct StrainExcess {
  double share = 0;      // strain divided by its limit
  std::string sentence;  // "region wood: the motion strained 3 of 400 elements along material axis 1 to ..."
};
// For each elastic term a norm of Green's strain up to which no limit is exceeded; infinite if the term has no limit.
std::vector<double> safe_green_strains(const FemModel& model);
// Whether any term exceeds its norm. Otherwise strain_excess() finds nothing.
bool is_near_strain_limit(const FemModel& model, const std::vector<double>& safe, const NodalState& state);
std::optional<StrainExcess> strain_excess(const FemModel& model, const NodalState& state);

// Whether any corotational region has a strain limit that a body can reach, in a model of any size.
bool has_strain_limits(const FemModel& model);

}  // namespace orthodyn
