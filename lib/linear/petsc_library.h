// The way into the library that PETSc's solvers are in.
#pragma once

#include <string>

namespace orthodyn {

class LinearSolver;

// Of the type of its function `orthodyn_make_petsc_solver`: the caller owns the solver.
using MakePetscSolver = LinearSolver*(const std::string& options);

}  // namespace orthodyn
