// Solvers of one process for matrices of which several ranks have parts.
#pragma once

#include <memory>

#include "lib/linear/solver.h"

namespace orthodyn {

// The first rank gets the whole matrix and has `solver`, a direct one, do the work while the others wait: for matrices
// whose factor costs less than what ranks would tell each other. The same number of ranks gives the same bits. All
// calls but description() and factor_bytes() are collective.
std::unique_ptr<LinearSolver> make_gathered_solver(std::unique_ptr<LinearSolver> solver);

// Analyses a solver of one process for matrices on this pattern, gathered if several ranks have parts of them.
std::unique_ptr<LinearSolver> prepare(std::unique_ptr<LinearSolver> solver, const Pattern& pattern);

}  // namespace orthodyn
