// A SUNMatrix and a SUNLinearSolver whose work is done by C++ functions.
#pragma once

#include <functional>

#include "integrators/sundials/handles.h"

namespace orthodyn::sundials {

// A matrix without entries, for a linear solver that keeps its own: its operations do nothing. Throws RunError if
// memory is short, as does the next.
OwnedMatrix make_placeholder_matrix(SUNContext context);

// A linear solver, direct or iterative. An iterative one is told how large the error of a solution may be, in the norm
// of the error test: SUNDIALS' share (eplifac) of what is allowed to Newton's method. Both functions return 0, > 0
// (recoverable) or < 0 (fatal); `solver` must outlive the handle.
struct SolverFunctions {
  std::function<int()> setup;
  std::function<int(N_Vector x, N_Vector b, double tolerance)> solve;
  bool iterative = false;
};
OwnedSolver make_solver_adapter(SolverFunctions& solver, SUNContext context);

}  // namespace orthodyn::sundials
