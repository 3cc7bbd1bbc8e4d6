// The operations of SUNDIALS' vectors, compiled for this processor. As distributions build them they take one number at
// a time: a quarter of a run of cvode_bdf with 2,700 unknowns.
#pragma once

#include <sundials/sundials_nvector.h>

namespace orthodyn::sundials {

// Replaces those operations that integrators spend their time in. Copies by N_VClone have them, too. Results do not
// depend on the addresses of the numbers. Precondition: v is a serial vector.
void use_fast_operations(N_Vector v);

}  // namespace orthodyn::sundials
