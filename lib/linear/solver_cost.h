// What factors and iterations take, measured (docs/decisions.md): for choices between methods before a run.
#pragma once

namespace orthodyn::solver_cost {

// ns: of a factor for each of its entries, in a solution, and for each multiplication; of an iteration with multigrid
// and of its set-up for each entry of the matrix, both triangles counted.
inline constexpr double kSolve = 1, kFactor = 0.1, kIteration = 16, kSetUp = 330;
inline constexpr double kBytesPerEntry = 10;  // of the factor, workspace included
inline constexpr double kIterations = 18;     // of a solution

}  // namespace orthodyn::solver_cost
