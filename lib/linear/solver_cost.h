// Measured costs of direct and iterative linear solvers, used to choose a solver before a run. The costs of factors
// were measured with CHOLMOD at 57,600 unknowns. In single precision `cholesky` is two to three times as fast
// (docs/performance.md).
#pragma once

namespace orthodyn::solver_cost {

// Times in ns. kSolve: one solution, per entry of the factor. kFactor: the factorisation, per multiplication.
// kIteration and kSetUp: one iteration with multigrid and the set-up of multigrid, per entry of the matrix (both
// triangles).
inline constexpr double kSolve = 1, kFactor = 0.1, kIteration = 16, kSetUp = 330;
inline constexpr double kBytesPerEntry = 8;  // memory per entry of the factor
inline constexpr double kIterations = 18;    // iterations per solution

}  // namespace orthodyn::solver_cost
