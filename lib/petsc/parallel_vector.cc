// SUNDIALS' vectors of several ranks (integrators/sundials/parallel_vector.h).
#include <nvector/nvector_mpiplusx.h>

#include "lib/petsc/session.h"

// The clone has its own part and frees it; what it is a clone of does not own the one that it was made from.
extern "C" [[gnu::visibility("default")]] N_Vector orthodyn_make_parallel_vector(N_Vector local, SUNContext context) {
  const N_Vector around = N_VMake_MPIPlusX(PETSC_COMM_WORLD, local, context);
  if (!around) return nullptr;
  const N_Vector own = N_VClone(around);
  N_VDestroy(around);
  if (own) N_VConst(0, own);
  return own;
}
