// Lets a linear solver for one process solve systems whose matrix is distributed over several ranks.
#pragma once

#include <memory>

#include "lib/linear/solver.h"

namespace orthodyn {

// Returns the solver after analyze(pattern). If the pattern is distributed, the returned solver gathers the matrix on
// the first rank, which solves while the others wait; `solver` must then be direct, otherwise ConfigError is thrown.
// This is faster if a factor costs less than communication between ranks. Results are then reproducible for the same
// number of ranks, and all calls except description() and factor_bytes() are collective.
std::unique_ptr<LinearSolver> prepare(std::unique_ptr<LinearSolver> solver, const Pattern& pattern);

}  // namespace orthodyn
