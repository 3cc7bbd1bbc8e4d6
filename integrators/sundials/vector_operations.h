// The operations of SUNDIALS' serial vectors, vectorised for this processor. The builds of Linux distributions are
// scalar; their operations account for a quarter of the time of a cvode_bdf run with 2,700 unknowns.
#pragma once

#include <sundials/sundials_nvector.h>

namespace orthodyn::sundials {

// Replaces those operations of v and its clones that cost integrators the most time. Results do not depend on the
// alignment of the data. Precondition: v is a serial vector.
void use_fast_operations(N_Vector v);

}  // namespace orthodyn::sundials
