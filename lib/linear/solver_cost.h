// Measured costs of factors and iterations, by which a method is chosen before a run. Factors were measured with
// CHOLMOD at 57,600 unknowns. In single precision `cholesky` is two to three times as fast (docs/performance.md).
#pragma once

namespace orthodyn::solver_cost {

// Times in ns. kSolve: a solution, per entry of the factor. kFactor: a factorisation, per multiplication. kIteration
// and kSetUp: an iteration and the set-up of multigrid, per entry of the matrix (both triangles).
inline constexpr double kSolve = 1, kFactor = 0.1, kIteration = 16, kSetUp = 330;
inline constexpr double kBytesPerEntry = 8;  // memory per entry of the factor
inline constexpr double kIterations = 18;    // iterations per solution

}  // namespace orthodyn::solver_cost
