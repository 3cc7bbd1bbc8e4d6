// Lets a linear solver for one process solve systems whose matrix is distributed over several ranks.
#pragma once

#include <memory>

#include "lib/linear/solver.h"

namespace orthodyn {

// Analyses a direct solver for matrices on this pattern and returns it. If the pattern is distributed, the first rank
// gathers the matrix and solves while the others wait. This pays if a factor costs less than communication between
// ranks. Results are then reproducible for the same number of ranks, and all calls except description() and
// factor_bytes() are collective.
std::unique_ptr<LinearSolver> prepare(std::unique_ptr<LinearSolver> solver, const Pattern& pattern);

}  // namespace orthodyn
