// The Lyapunov equation S X + X S = B for symmetric S and B, S positive definite; for one point or a batch.
#pragma once

#include "lib/core/types.h"

namespace orthodyn {

// Gaussian elimination of the six equations for X. The diagonal equations are halved:
//     S_ii X_ii + S_ij X_ij + S_ki X_ki = B_ii / 2.
// The matrix of the equations is then symmetric positive definite (up to scaling it is S (x) I + I (x) S on symmetric
// matrices), so no pivoting is needed and the condition of S governs the error. Eliminating the diagonal of X leaves
// three equations.
template <class T>
Mat3T<T> solve_lyapunov(const Mat3T<T>& S, const Mat3T<T>& B) {
  const T a = S(0, 1), b = S(1, 2), c = S(2, 0);
  const T i0 = T(1) / S(0, 0), i1 = T(1) / S(1, 1), i2 = T(1) / S(2, 2);
  const T d0 = T(0.5) * B(0, 0) * i0, d1 = T(0.5) * B(1, 1) * i1, d2 = T(0.5) * B(2, 2) * i2;
  // The equations for X_01, X_12, X_20.
  const T a00 = S(0, 0) + S(1, 1) - a * a * (i0 + i1), a11 = S(1, 1) + S(2, 2) - b * b * (i1 + i2),
          a22 = S(2, 2) + S(0, 0) - c * c * (i2 + i0);
  const T a01 = c - a * b * i1, a12 = a - b * c * i2, a02 = b - a * c * i0;
  const T r0 = B(0, 1) - a * (d0 + d1), r1 = B(1, 2) - b * (d1 + d2), r2 = B(2, 0) - c * (d2 + d0);
  const T l1 = a01 / a00, l2 = a02 / a00;
  const T b11 = a11 - l1 * a01, b12 = a12 - l1 * a02, b22 = a22 - l2 * a02, y1 = r1 - l1 * r0;
  const T l = b12 / b11;
  const T z = (r2 - l2 * r0 - l * y1) / (b22 - l * b12), y = (y1 - b12 * z) / b11, x = (r0 - a01 * y - a02 * z) / a00;
  Mat3T<T> X;
  X(0, 1) = X(1, 0) = x;
  X(1, 2) = X(2, 1) = y;
  X(2, 0) = X(0, 2) = z;
  X(0, 0) = d0 - i0 * (a * x + c * z);
  X(1, 1) = d1 - i1 * (a * x + b * y);
  X(2, 2) = d2 - i2 * (b * y + c * z);
  return X;
}

}  // namespace orthodyn
