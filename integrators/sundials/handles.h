// SUNDIALS' C handles as owning C++ values, and its vectors as Eigen views.
#pragma once

#include <nvector/nvector_serial.h>
#include <sundials/sundials_linearsolver.h>
#include <sundials/sundials_matrix.h>

#include <memory>
#include <type_traits>

#include "integrators/sundials/vector_operations.h"
#include "integrators/sundials/version.h"
#include "lib/core/errors.h"
#include "lib/core/ranks.h"
#include "lib/core/types.h"

namespace orthodyn::sundials {

template <auto destroy>
struct Destroy {
  template <class T>
  void operator()(T* handle) const {
    destroy(handle);
  }
};

template <class Handle, auto destroy>
using Owned = std::unique_ptr<std::remove_pointer_t<Handle>, Destroy<destroy>>;

using OwnedVector = Owned<N_Vector, N_VDestroy>;
using OwnedMatrix = Owned<SUNMatrix, SUNMatDestroy>;
using OwnedSolver = Owned<SUNLinearSolver, SUNLinSolFree>;

// Declare a Context before everything created in it, so that it is destroyed last.
class Context {
 public:
  Context() {
    if (create_context(&context_) != 0) throw RunError("SUNDIALS could not create its context");
  }
  ~Context() { SUNContext_Free(&context_); }
  Context(const Context&) = delete;
  Context& operator=(const Context&) = delete;
  operator SUNContext() const { return context_; }

 private:
  SUNContext context_ = nullptr;
};

// Makes a vector distributed over the ranks (SUNDIALS' MPIPlusX), whose sums and norms are global. This rank's part has
// the size and the operations of `local`. Free the vector by N_VDestroy(). The code is in liborthodyn_petsc, which
// links MPI. Throws RunError if memory is short. Precondition: this process is one of several ranks.
N_Vector parallel_vector_like(N_Vector local, SUNContext context);

// Makes a vector of `size` zeros; with `ranks`, a vector distributed over the ranks, of which this rank holds `size`
// zeros.
inline OwnedVector make_vector(Eigen::Index size, SUNContext context, const Ranks* ranks = nullptr) {
  OwnedVector v(N_VNew_Serial(static_cast<sunindextype>(size), context));
  if (!v) throw RunError("SUNDIALS could not allocate a vector", Reason::out_of_memory);
  use_fast_operations(v.get());
  if (ranks) v.reset(parallel_vector_like(v.get(), context));
  N_VConst(0, v.get());
  return v;
}

// The entries held by this process.
inline Eigen::Map<Vector> view(N_Vector v) {
  const sunindextype length = v->ops->nvgetlocallength ? v->ops->nvgetlocallength(v) : N_VGetLength(v);
  return {N_VGetArrayPointer(v), static_cast<Eigen::Index>(length)};
}

// Numbers of unknowns besides q and v: internal variables z (lib/ode/internal_variables.h), and constraints
// (lib/ode/constraints.h), each with the multipliers lambda of the velocities and mu of the positions.
struct Extra {
  Eigen::Index internals = 0, constraints = 0;
  Eigen::Index size() const { return internals + 2 * constraints; }
};

// The parts of the integrators' state y = (q, v, z, lambda, mu).
inline auto positions(N_Vector y, const Extra& extra = {}) {
  auto all = view(y);
  return Eigen::Map<Vector>(all.data(), (all.size() - extra.size()) / 2);
}
inline auto velocities(N_Vector y, const Extra& extra = {}) {
  auto all = view(y);
  const Eigen::Index n = (all.size() - extra.size()) / 2;
  return Eigen::Map<Vector>(all.data() + n, n);
}
inline auto internal_part(N_Vector y, const Extra& extra) {
  auto all = view(y);
  return Eigen::Map<Vector>(all.data() + (all.size() - extra.size()), extra.internals);
}
inline auto velocity_multipliers(N_Vector y, const Extra& extra) {
  auto all = view(y);
  return Eigen::Map<Vector>(all.data() + (all.size() - 2 * extra.constraints), extra.constraints);
}
inline auto position_multipliers(N_Vector y, const Extra& extra) {
  auto all = view(y);
  return Eigen::Map<Vector>(all.data() + (all.size() - extra.constraints), extra.constraints);
}

}  // namespace orthodyn::sundials
