// SUNDIALS vectors distributed over ranks (integrators/sundials/handles.h).
#include <nvector/nvector_mpiplusx.h>

#include "lib/petsc/session.h"

// Returns a clone, because only a clone owns and frees its local part.
extern "C" [[gnu::visibility("default")]] N_Vector orthodyn_make_parallel_vector(N_Vector local, SUNContext context) {
  const N_Vector around = N_VMake_MPIPlusX(PETSC_COMM_WORLD, local, context);
  if (!around) return nullptr;
  const N_Vector own = N_VClone(around);
  N_VDestroy(around);
  if (own) N_VConst(0, own);
  return own;
}
