// Polar decomposition F = R S with a proper rotation R and a symmetric S. The eigenvalues of S are s1 >= s2 >= |s3|; s3
// has the sign of det F.
//
// R maximises tr(R^T F). It is unique if and only if G = tr(S) I - S is positive definite (s2 + s3 > 0). Otherwise,
// e.g. for F = 0 or a mirrored element, the maximiser nearest to `tie` is taken, so that all elements resolve ties
// alike. To round-off, R is a pure function of F and `tie`.
//
// Method: the quaternion q of R is the eigenvector of Davenport's symmetric 4x4 matrix for its largest eigenvalue
// tr(S). This eigenvalue is the largest root of a quartic, found by Newton's method from above, and q is a column of
// the adjugate. Newton steps R <- R cay(G^-1 a(R^T F)), with the Cayley transform cay, follow until a(R^T F) vanishes
// to round-off. If the final check fails, a symmetric eigensolver is used. Batches near rotations need fewer steps
// (polar_steps.h). Thread-safe.
#pragma once

#include <complex>

#include "lib/core/types.h"
#include "lib/element/batch.h"

namespace orthodyn {

template <class T>
struct Polar {
  Mat3T<T> R, S;
  Mat3T<T> G_inverse;  // valid if det_G > 0
  T det_G;             // (s1+s2)(s2+s3)(s3+s1)
};

// Throws RecoverableError if F is not finite.
Polar<double> polar(const Mat3& F, const Mat3& tie);

// The analytic continuation, for complex-step derivatives. Precondition: F is regular (s2 + s3 > 0).
Polar<std::complex<double>> polar(const Mat3T<std::complex<double>>& F, const Mat3& tie);

// As above for a batch. Lanes outside the returned mask are invalid and must be computed by polar(F, tie).
Batch::Mask polar(const Mat3T<Batch>& F, Polar<Batch>& p);

}  // namespace orthodyn
