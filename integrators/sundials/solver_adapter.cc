#include "integrators/sundials/solver_adapter.h"

#include <cmath>

namespace orthodyn::sundials {

namespace {

SolverFunctions& functions(SUNLinearSolver S) { return *static_cast<SolverFunctions*>(S->content); }

SUNLinearSolver_Type type(SUNLinearSolver S) {
  return functions(S).iterative ? SUNLINEARSOLVER_MATRIX_ITERATIVE : SUNLINEARSOLVER_DIRECT;
}
SUNLinearSolver_ID id(SUNLinearSolver) { return SUNLINEARSOLVER_CUSTOM; }
int setup(SUNLinearSolver S, SUNMatrix) { return functions(S).setup(); }
int solve(SUNLinearSolver S, SUNMatrix, N_Vector x, N_Vector b, sunrealtype tolerance) {
  // SUNDIALS gives the tolerance of the weighted 2-norm; the error test uses the root mean square.
  const int flag = functions(S).solve(x, b, tolerance / std::sqrt(static_cast<double>(N_VGetLength(x))));
  // CVODE, IDA and ARKODE treat return values that they do not know as success.
  return flag == 0 || !functions(S).iterative ? flag : flag > 0 ? SUNLS_CONV_FAIL : SUNLS_ATIMES_FAIL_UNREC;
}

}  // namespace

OwnedMatrix make_placeholder_matrix(SUNContext context) {
  OwnedMatrix A(SUNMatNewEmpty(context));
  if (!A) throw RunError("SUNDIALS could not allocate a matrix", Reason::out_of_memory);
  A->ops->getid = [](SUNMatrix) { return SUNMATRIX_CUSTOM; };
  A->ops->zero = [](SUNMatrix) { return 0; };
  A->ops->destroy = [](SUNMatrix M) { SUNMatFreeEmpty(M); };
  return A;
}

OwnedSolver make_solver_adapter(SolverFunctions& solver, SUNContext context) {
  OwnedSolver S(SUNLinSolNewEmpty(context));
  if (!S) throw RunError("SUNDIALS could not allocate a linear solver", Reason::out_of_memory);
  S->content = &solver;
  S->ops->gettype = type;
  S->ops->getid = id;
  S->ops->setup = setup;
  S->ops->solve = solve;
  if (solver.iterative) {
    // The library passes the error weights, which are already known here. Without this function it would use their
    // mean.
    S->ops->setscalingvectors = [](SUNLinearSolver, N_Vector, N_Vector) { return 0; };
    // IDA calls both functions. If the number of iterations were 0, it would use the residual as the solution.
    S->ops->numiters = [](SUNLinearSolver) { return 1; };
    S->ops->resid = [](SUNLinearSolver) -> N_Vector { return nullptr; };
  }
  S->ops->free = [](SUNLinearSolver L) {
    L->content = nullptr;
    SUNLinSolFreeEmpty(L);
    return 0;
  };
  return S;
}

}  // namespace orthodyn::sundials
