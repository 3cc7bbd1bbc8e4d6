// Whether a full 6x6 stiffness is positive definite, and the nearest that is.
//
// Voigt order 11, 22, 33, 12, 23, 31 (stiffness.h). Eigenvalues are those of the tensor: of the matrix
// on an orthonormal basis of strains (Mandel's), in Pa. Stability is judged on D^-1/2 C D^-1/2 with D the
// diagonal of C, so that it does not depend on the ratio of the moduli; its off-diagonal part plays the
// role of the scaled Poisson's ratios in orthotropy.h, and shrinking it is the same repair.
#pragma once

#include <string>

#include "lib/material/stiffness.h"

namespace orthodyn {

// The matrix on the orthonormal basis of symmetric tensors (11, 22, 33, sqrt(2) 12, ...).
Mat6 mandel(const Mat6& C);

// Precondition of the following: a positive diagonal.
bool is_stable(const AnisotropicStiffness& C);

// The largest common factor <= 1 of all entries off the diagonal that leaves the smallest eigenvalue of
// the unit-diagonal matrix at or above `margin`.
double stabilising_factor(const AnisotropicStiffness& C, double margin = 0.05);
AnisotropicStiffness shrink_couplings(const AnisotropicStiffness& C, double factor);

// "smallest eigenvalue -2.1e8 Pa, of the strain e11=0.7, e22=-0.7, ..."
std::string describe_softest_strain(const AnisotropicStiffness& C);

}  // namespace orthodyn
