#include "integrators/sundials/solver_adapter.h"

namespace orthodyn::sundials {

namespace {

SolverFunctions& functions(SUNLinearSolver S) { return *static_cast<SolverFunctions*>(S->content); }

SUNLinearSolver_Type type(SUNLinearSolver) { return SUNLINEARSOLVER_DIRECT; }
SUNLinearSolver_ID id(SUNLinearSolver) { return SUNLINEARSOLVER_CUSTOM; }
int setup(SUNLinearSolver S, SUNMatrix) { return functions(S).setup(); }
int solve(SUNLinearSolver S, SUNMatrix, N_Vector x, N_Vector b, sunrealtype) { return functions(S).solve(x, b); }

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
  S->ops->free = [](SUNLinearSolver L) {
    L->content = nullptr;
    SUNLinSolFreeEmpty(L);
    return 0;
  };
  return S;
}

}  // namespace orthodyn::sundials
