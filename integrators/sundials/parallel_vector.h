// SUNDIALS' vectors of which several ranks have parts: its MPIPlusX, whose sums and norms are those of the whole. It is
// made in liborthodyn_petsc, where MPI is.
#pragma once

#include <sundials/sundials_nvector.h>

namespace orthodyn::sundials {

// Of which `local`, a vector that is whole, is like this rank's part; to be freed by N_VDestroy(). Throws RunError
// where memory does not suffice. Precondition: this process is one of several ranks.
N_Vector parallel_vector_like(N_Vector local, SUNContext context);

}  // namespace orthodyn::sundials
