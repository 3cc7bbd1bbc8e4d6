// Computes the eigenpairs (nu, x) of A x = nu B x with the most negative nu, for symmetric A and B on one pattern, B
// positive definite. The method is Lanczos iteration on B^-1 A in the inner product of B (through Spectra), or a dense
// solver for small matrices. Lanczos converges fast if B^-1 A is nearly compact, because the ends of its spectrum are
// then well separated. This is the case for a stress stiffness A and an elastic stiffness B. Thread-safe.
#pragma once

#include <vector>

#include "lib/core/pattern.h"

namespace orthodyn {

struct NegativeEigenPairs {
  Vector values;           // ascending
  Eigen::MatrixXd shapes;  // one column per pair, B-orthonormal
};

// Returns at most `count` pairs with nu < -bound, bound > 0. `A` and `B`: values on `pattern`. Throws ConfigError if
// the pattern is unsymmetric, RunError if B is not positive definite or the iteration fails.
NegativeEigenPairs negative_eigenpairs(const Pattern& pattern, const std::vector<double>& A,
                                       const std::vector<double>& B, double bound, int count);

}  // namespace orthodyn
