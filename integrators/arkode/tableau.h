// ARKODE's Butcher tableaux, extended so that the last stage is the end of the step.
//
// A tableau that lacks such a stage gets one more explicit stage with c = 1, row a = b and weight 0. This stage costs
// nothing, because the next step starts with its force. If the force cannot be evaluated at the end of a step, the step
// fails while a shorter one can still avoid the failure.
#pragma once

// clang-format off
#include <cstdio>  // FILE, which the next header names without declaring it
#include <arkode/arkode_butcher.h>
// clang-format on

#include "integrators/sundials/handles.h"

namespace orthodyn::sundials {

using Tableau = Owned<ARKodeButcherTable, ARKodeButcherTable_Free>;

// True if the last stage is the end of the step.
bool ends_in_a_stage(const ARKodeButcherTableMem& tableau);

// Returns a copy with the additional stage. Throws RunError if memory is short.
Tableau with_end_stage(const ARKodeButcherTableMem& tableau);

// Returns the tableau itself if its last stage is the end of the step, otherwise with_end_stage().
inline Tableau ending_in_a_stage(Tableau tableau) {
  return ends_in_a_stage(*tableau) ? std::move(tableau) : with_end_stage(*tableau);
}

}  // namespace orthodyn::sundials
