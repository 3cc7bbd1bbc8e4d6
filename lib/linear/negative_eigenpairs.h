// The pairs (nu, x) with the most negative nu of A x = nu B x, A and B symmetric on one pattern, B positive definite:
// Lanczos iteration on B^-1 A in the inner product of B (through Spectra), dense for small matrices. Well separated are
// the ends of the spectrum where B^-1 A is nearly compact, as for a stress stiffness against a stiffness.
//
// No state is kept: may be called by several threads.
#pragma once

#include <vector>

#include "lib/core/pattern.h"

namespace orthodyn {

struct NegativeEigenPairs {
  Vector values;           // ascending
  Eigen::MatrixXd shapes;  // a column each, B-orthonormal
};

// Those with nu < -bound, bound > 0, at most `count`. A and B by their values on `pattern`. Throws ConfigError if the
// pattern is not symmetric, RunError if B is not positive definite or the iteration fails.
NegativeEigenPairs negative_eigenpairs(const Pattern& pattern, const std::vector<double>& A,
                                       const std::vector<double>& B, double bound, int count);

}  // namespace orthodyn
