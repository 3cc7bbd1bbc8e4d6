// A SUNMatrix without entries and a SUNLinearSolver that calls C++ functions.
#pragma once

#include <functional>

#include "integrators/sundials/handles.h"

namespace orthodyn::sundials {

// Makes a matrix whose operations do nothing, for a linear solver that keeps its own matrix. Throws RunError if memory
// is short.
OwnedMatrix make_placeholder_matrix(SUNContext context);

// The functions of a direct or iterative linear solver. `tolerance` is for iterative solvers: the allowed error of x in
// the norm of the error test, which is SUNDIALS' eplifac times the tolerance of Newton's method. Both functions return
// 0 (success), > 0 (recoverable) or < 0 (fatal).
struct SolverFunctions {
  std::function<int()> setup;
  std::function<int(N_Vector x, N_Vector b, double tolerance)> solve;
  bool iterative = false;
};
// `solver` must outlive the handle. Throws RunError if memory is short.
OwnedSolver make_solver_adapter(SolverFunctions& solver, SUNContext context);

}  // namespace orthodyn::sundials
