#include "integrators/sundials/handles.h"
#include "lib/linear/petsc_library.h"

namespace orthodyn::sundials {

N_Vector parallel_vector_like(N_Vector local, SUNContext context) {
  using Make = N_Vector(N_Vector local, SUNContext context);
  static auto* const make = reinterpret_cast<Make*>(petsc_function("orthodyn_make_parallel_vector"));
  const N_Vector vector = make(local, context);
  if (!vector) throw RunError("SUNDIALS could not allocate a vector", Reason::out_of_memory);
  return vector;
}

}  // namespace orthodyn::sundials
