// Natural frequencies and critical load factors that a scene expects.
#pragma once

#include <vector>

#include "lib/simulation/run/setup.h"
#include "lib/study/quantities/check.h"

namespace orthodyn::study {

// In the order of the expectations of such values; NaN for a mode that the model or the loads do not have. Throws what
// natural_modes() and buckling_modes() throw.
std::vector<Check> eigenvalue_checks(const Setup& setup);

}  // namespace orthodyn::study
