// The operations of SUNDIALS' vectors, compiled for this processor. As distributions build them they take one number at
// a time: 28 % of a run of cvode_bdf with 2,700 unknowns.
#pragma once

#include <sundials/sundials_nvector.h>

namespace orthodyn::sundials {

// Replaces those operations of a serial vector that integrators spend their time in. Copies by N_VClone have them, too.
// Results depend neither on the addresses of the numbers nor on the number of threads.
void use_fast_operations(N_Vector v);

}  // namespace orthodyn::sundials
