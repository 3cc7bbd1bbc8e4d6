// KINSOL's Newton iteration (Hindmarsh et al. 2005) for the unknowns (q, l) = (positions, load factor): f_l(q) = 0 on
// the plane a.(q - q*) + b (l - l*) = 0 through the guess (q*, l*). A correction (dq, dl) satisfies
//
//     [ K    -p ] [dq]   [ f_l                      ]
//     [ a^T   b ] [dl] = [ -a.(q - q*) - b (l - l*) ],    p = df_l/dl,
//
// and is found by two solves with K (Riks, Int. J. Solids Struct. 15, 1979). K has predicted stresses
// (Model::linearize_predicted), which permits long straight steps of slender bodies. It is factored in every iteration.
// Corrections must not grow (Deuflhard, Newton Methods for Nonlinear Problems, 2004); otherwise the solution might lie
// on another path. The residual need not decrease: it rises at first, because a straight step stretches the body.
//
// descend() uses the positive semidefinite part of K and limits the root mean square of each correction to the size of
// the motion.
//
// Round-off of large internal forces may keep the residual above its tolerance. A state is then accepted, with
// Attempt::above_tolerance set, if the next Newton correction relative to the motion is below rtol (only if K is exact)
// or below round-off.
#pragma once

#include <memory>
#include <string>

#include "lib/core/solver_choice.h"
#include "lib/statics/equilibrium.h"

namespace orthodyn::sundials {

struct KinsolOptions {
  double rtol = 1e-8;  // largest residual / EquilibriumTask::force
  long max_iterations = 50;
  SolverChoice linear_solver;
};

// Throws ConfigError if the linear solver does not accept the path's matrices. `path` must outlive the solver.
std::unique_ptr<EquilibriumSolver> make_kinsol(const LoadPath& path, const EquilibriumTask& task,
                                               const KinsolOptions& options);

}  // namespace orthodyn::sundials
