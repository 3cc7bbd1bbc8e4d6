// KINSOL's Newton iteration (Hindmarsh et al. 2005) for the unknowns (q, lambda): -f_lambda(q) = 0 on a plane
//
//     [ K    -f' ] [dq]   [ f                ]
//     [ a^T   b  ] [dl] = [ -a.(q - q*) - b (l - l*) ],    f' = df_lambda/dlambda,
//
// by two solves with K (Riks, Int. J. Solids Struct. 15, 1979). K, factored each time, is the mixed one
// (Model::linearize_mixed), with which straight steps of slender bodies may be long. Corrections must contract
// (Deuflhard, Newton Methods for Nonlinear Problems, 2004), else a solution is not one that the guess leads to. That
// the residual falls is not asked for: it rises first, by the stretching that a straight step brings.
//
// Down the energy: with the positive semidefinite part of K, each correction at most as long as the motion's size.
//
// Round-off of large internal forces may keep the residual from falling below the tolerance; a solution then is
// where Newton's next correction is below the tolerance of the motion, or round-off itself, and the attempt says so.
#pragma once

#include <memory>
#include <string>

#include "lib/core/solver_choice.h"
#include "lib/statics/equilibrium.h"

namespace orthodyn::sundials {

struct KinsolOptions {
  double rtol = 1e-8;
  long max_iterations = 50;
  SolverChoice linear_solver;
};

// Throws ConfigError if the linear solver does not take the path's matrices. `path` must outlive it.
std::unique_ptr<EquilibriumSolver> make_kinsol(const LoadPath& path, const EquilibriumTask& task,
                                               const KinsolOptions& options);

}  // namespace orthodyn::sundials
