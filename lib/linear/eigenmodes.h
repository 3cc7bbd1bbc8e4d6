// The lowest pairs (lambda, x) of K x = lambda M x with symmetric K and M on one pattern, M positive definite:
// Lanczos iteration on (K + s M)^-1 M (Ericsson & Ruhe 1980, through Spectra), dense for small matrices.
//
// The shift s > 0 makes K + s M positive definite where K alone is not, as for a body that nothing holds. Eigenvalues
// that round-off does not tell from zero, those below a hundred eps of the largest, are set to zero. Where there are
// some, a second pass with a shift of the size of the lowest other eigenvalue finds that one to full accuracy.
//
// No state is kept: may be called by several threads.
#pragma once

#include <vector>

#include "lib/core/pattern.h"

namespace orthodyn {

struct EigenPairs {
  Vector values;           // ascending, in the unit of K over that of M (1/s^2); zeros are exactly 0
  Eigen::MatrixXd shapes;  // a column each, M-orthonormal
  int zeros = 0;
  double resolution = 0;   // eigenvalues below it count as zero
};

// K and M by their values on `pattern`. Throws ConfigError if the pattern is not symmetric or there are fewer
// unknowns than modes, RunError if the iteration fails or K is so indefinite that no shift of a moderate size helps.
EigenPairs lowest_eigenpairs(const Pattern& pattern, const std::vector<double>& K, const std::vector<double>& M,
                             int count);

}  // namespace orthodyn
