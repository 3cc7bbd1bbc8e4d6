// Stability of a full 6x6 stiffness, and its repair.
//
// Voigt order 11, 22, 33, 12, 23, 31 (stiffness.h). Eigenvalues are those of the tensor, that is of the Mandel matrix,
// in Pa. Stability is tested on D^-1/2 C D^-1/2, where D is the diagonal of C, so that it does not depend on the ratio
// of the moduli. The off-diagonal entries of this scaled matrix correspond to the scaled Poisson's ratios of
// orthotropy.h and are shrunk likewise.
#pragma once

#include <string>

#include "lib/material/stiffness.h"

namespace orthodyn {

// The Mandel matrix: C in the orthonormal basis of symmetric tensors (11, 22, 33, sqrt(2) 12, ...).
Mat6 mandel(const Mat6& C);

// Precondition of the following functions: the diagonal is positive.
bool is_stable(const AnisotropicStiffness& C);

// The largest factor <= 1 on all off-diagonal entries for which the scaled matrix has no eigenvalue < margin.
double stabilising_factor(const AnisotropicStiffness& C, double margin = 0.05);
AnisotropicStiffness shrink_couplings(const AnisotropicStiffness& C, double factor);

// For messages: "smallest eigenvalue -2.1e8 Pa, of the strain e11=0.7, e22=-0.7, ..."
std::string describe_softest_strain(const AnisotropicStiffness& C);

}  // namespace orthodyn
