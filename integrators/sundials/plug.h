// A SUNMatrix and a SUNLinearSolver with no life of their own: SUNDIALS asks, C++ functions answer.
#pragma once

#include <functional>

#include "integrators/sundials/handles.h"

namespace orthodyn::sundials {

// A matrix that nobody reads: the linear solver keeps its own. Its operations do nothing.
OwnedMatrix make_matrix_plug(SUNContext context);

// A direct linear solver. Both functions return 0, > 0 (recoverable) or < 0 (fatal); `solver` must
// outlive the handle.
struct SolverFunctions {
  std::function<int()> setup;
  std::function<int(N_Vector x, N_Vector b)> solve;
};
OwnedSolver make_solver_plug(SolverFunctions& solver, SUNContext context);

}  // namespace orthodyn::sundials
