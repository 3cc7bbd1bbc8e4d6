// Polar decomposition F = R S, R a proper rotation, S symmetric with s1 >= s2 >= |s3| (signed).
//
// R maximises tr(R^T F). It is unique exactly where G = tr(S) I - S is positive definite
// (s2 + s3 > 0); elsewhere, e.g. for F = 0 or a mirrored element, the maximiser nearest to `tie` is
// taken, so that ties are resolved alike in all elements. R is a pure function of F and `tie`, to round-off:
// no iteration depends on earlier steps.
//
// Method: q = the quaternion of R is the top eigenvector of Davenport's symmetric 4x4 matrix; its
// eigenvalue tr(S) is the largest root of a quartic, found by Newton's method from above, q a column
// of the adjugate; then Newton steps R <- R cay(G^-1 a(R^T F)) until a(R^T F) vanishes to round-off.
// Whatever does not pass the check goes through a symmetric eigensolver. Batches near rotations take fewer steps
// (polar_steps.h). Pure functions, safe in any thread.
#pragma once

#include <complex>

#include "lib/core/types.h"
#include "lib/element/batch.h"

namespace orthodyn {

template <class T>
struct Polar {
  Mat3T<T> R, S;
  Mat3T<T> G_inverse;  // meaningful where det_G > 0
  T det_G;             // (s1+s2)(s2+s3)(s3+s1)
};

// Throws RecoverableError if F is not finite.
Polar<double> polar(const Mat3& F, const Mat3& tie);

// The analytic continuation of the above, for complex-step derivatives; F regular (s2 + s3 > 0).
Polar<std::complex<double>> polar(const Mat3T<std::complex<double>>& F, const Mat3& tie);

// Of a batch: lanes outside the returned mask must be computed again by the first function, which handles all cases.
Batch::Mask polar(const Mat3T<Batch>& F, Polar<Batch>& p);

}  // namespace orthodyn
