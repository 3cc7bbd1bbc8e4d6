// The lowest pairs (lambda, x) of K x = lambda M x with symmetric K and M on one pattern, M positive definite:
// Lanczos iteration on (K + s M)^-1 M (Ericsson & Ruhe 1980, through Spectra), dense for small matrices.
//
// The shift s > 0 makes K + s M positive definite where K alone is not, as for a body that nothing holds. Eigenvalues
// that round-off does not tell from zero, those below a hundred eps of the largest, are set to zero. Where there are
// some, a second pass with a shift of the size of the lowest other eigenvalue finds that one to full accuracy.
//
// K + s M is factored where the factor fits in memory; else PETSc's conjugate gradients with multigrid take its place.
//
// No state is kept: may be called by several threads.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "lib/core/pattern.h"

namespace orthodyn {

struct EigenPairs {
  Vector values;           // ascending, in the unit of K over that of M (1/s^2); zeros are exactly 0
  Eigen::MatrixXd shapes;  // a column each, M-orthonormal
  Vector residuals = {};   // |K x - lambda M x| / |lambda_ref M x|, lambda_ref of x or the lowest that is not zero
  int zeros = 0;
  double resolution = 0;    // eigenvalues below it count as zero
  std::string solver = {};  // what solved the systems with K + s M
};

enum class ShiftedSolver { whatever_fits, iterative };

// The motions that K resists least, n x 6, for multigrid; called if it is taken.
using SoftestMotions = std::function<Eigen::MatrixXd()>;

// K and M by their values on `pattern`. `softest`: may be empty. Throws ConfigError if the pattern is not symmetric or
// there are fewer unknowns than modes, RunError if the iteration fails, if a residual is above 1e-6 and above
// round-off, or if K is so indefinite that no shift of a moderate size helps.
EigenPairs lowest_eigenpairs(const Pattern& pattern, const std::vector<double>& K, const std::vector<double>& M,
                             int count, const SoftestMotions& softest = {},
                             ShiftedSolver solver = ShiftedSolver::whatever_fits);

}  // namespace orthodyn
