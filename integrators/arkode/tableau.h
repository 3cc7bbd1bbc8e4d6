// Butcher tableaux of ARKODE whose last stage is the step's end.
//
// A method that does not have this gets a further, explicit stage with c = 1 and a = b, and no weight: the
// force there is the one that the next step begins with, so that it costs nothing; and where it cannot be
// evaluated the step is refused while a shorter one can still avoid that.
#pragma once

#include <arkode/arkode_butcher.h>

#include <cstdio>  // before the next, which names FILE

#include "integrators/sundials/handles.h"

namespace orthodyn::sundials {

using Tableau = Owned<ARKodeButcherTable, ARKodeButcherTable_Free>;

// True if the last stage is the step's end.
bool ends_in_a_stage(const ARKodeButcherTableMem& tableau);

// A copy that ends in such a stage. Throws RunError if memory is short.
Tableau with_end_stage(const ARKodeButcherTableMem& tableau);

}  // namespace orthodyn::sundials
