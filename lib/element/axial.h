// Skew matrices and axial vectors: [w] y = w x y (cross product), and a(A) is twice the axial vector of the skew part
// of A. For symmetric S, a([w] S) = G w with G = tr(S) I - S.
#pragma once

#include "lib/core/types.h"

namespace orthodyn {

template <class T>
Vec3T<T> axial(const Mat3T<T>& A) {
  return {A(2, 1) - A(1, 2), A(0, 2) - A(2, 0), A(1, 0) - A(0, 1)};
}

template <class T>
Mat3T<T> cross_matrix(const Vec3T<T>& w) {
  Mat3T<T> W;
  W << T(0), -w[2], w[1], w[2], T(0), -w[0], -w[1], w[0], T(0);
  return W;
}

template <class T>
Mat3T<T> symmetric_part(const Mat3T<T>& A) {
  return T(0.5) * (A + A.transpose());
}

// The double contraction A : B.
template <class T>
T contract(const Mat3T<T>& A, const Mat3T<T>& B) {
  return A.cwiseProduct(B).sum();
}

// The Voigt form of a symmetric strain, with engineering shear (stiffness.h).
template <class T>
Vec6T<T> voigt_strain(const Mat3T<T>& e) {
  return {e(0, 0), e(1, 1), e(2, 2), T(2) * e(0, 1), T(2) * e(1, 2), T(2) * e(2, 0)};
}

template <class T>
Mat3T<T> cofactor_of_symmetric(const Mat3T<T>& A) {
  Mat3T<T> C;
  C(0, 0) = A(1, 1) * A(2, 2) - A(1, 2) * A(1, 2);
  C(1, 1) = A(0, 0) * A(2, 2) - A(0, 2) * A(0, 2);
  C(2, 2) = A(0, 0) * A(1, 1) - A(0, 1) * A(0, 1);
  C(0, 1) = C(1, 0) = A(0, 2) * A(1, 2) - A(0, 1) * A(2, 2);
  C(0, 2) = C(2, 0) = A(0, 1) * A(1, 2) - A(0, 2) * A(1, 1);
  C(1, 2) = C(2, 1) = A(0, 1) * A(0, 2) - A(0, 0) * A(1, 2);
  return C;
}

}  // namespace orthodyn
