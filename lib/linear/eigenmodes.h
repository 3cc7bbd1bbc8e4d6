// Computes the lowest eigenpairs (lambda, x) of K x = lambda M x for symmetric K and M on one pattern, M positive
// definite. The method is Lanczos iteration on (K + s M)^-1 M (Ericsson & Ruhe 1980, through Spectra), or a dense
// solver for small matrices.
//
// The shift s > 0 makes K + s M positive definite if K is singular, as for a free body. Eigenvalues below 100 eps
// (machine epsilon) times the largest one cannot be distinguished from zero and are set to zero. If there are any, a
// second pass with the lowest nonzero eigenvalue as the shift computes that eigenvalue to full accuracy.
//
// Systems with K + s M are solved by a factor if it fits in memory, else by PETSc's multigrid-CG. Thread-safe.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "lib/core/pattern.h"

namespace orthodyn {

struct EigenPairs {
  Vector values;           // ascending, in the unit of K over that of M (1/s^2); zeros are exactly 0
  Eigen::MatrixXd shapes;  // one column per pair, M-orthonormal
  Vector residuals = {};   // |K x - lambda M x| / |lambda_ref M x|, lambda_ref = max(lambda, lowest nonzero eigenvalue)
  int zeros = 0;
  double resolution = 0;    // eigenvalues below it count as zero
  std::string solver = {};  // description of the solver of K + s M
};

// Solver of the systems with K + s M. automatic: a factor if it fits in memory, else PETSc.
enum class ShiftedSolver { automatic, iterative };

// Returns the rigid motions, n x 6, for multigrid; called only if multigrid is used.
using RigidMotions = std::function<Eigen::MatrixXd()>;

// `K` and `M`: values on `pattern`. `rigid_motions` may be empty. Throws ConfigError if the pattern is unsymmetric or
// there are fewer unknowns than modes; RunError if the iteration fails, if a residual exceeds 1e-6 and round-off, or if
// K is so indefinite that no moderate shift makes K + s M positive definite.
EigenPairs lowest_eigenpairs(const Pattern& pattern, const std::vector<double>& K, const std::vector<double>& M,
                             int count, const RigidMotions& rigid_motions = {},
                             ShiftedSolver solver = ShiftedSolver::automatic);

// The number of modes for the next search for all modes with eigenvalues below `limit`, after `count` modes up to
// `reached`. Plates have modes in proportion to the frequency, bars fewer, solids more.
int more_modes(int count, double reached, double limit);
inline constexpr int kMostModesBelow = 2000;  // at which such a search gives up

}  // namespace orthodyn
