// The branch-free steps of the polar decomposition (polar.h), for one point or a batch. Only polar.cc includes this
// header, which is slow to compile.
#pragma once

#include "lib/element/axial.h"
#include "lib/element/polar.h"

namespace orthodyn {

namespace polar_detail {

inline constexpr double kRotationTolerance = 1e-15;  // target for |a(R^T F)| / |F|
inline constexpr double kAcceptTolerance = 1e-13;    // accepted |a(R^T F)| / |F|
inline constexpr double kSingularG = 1e-9;           // below this det G / |F|^3, R is not unique to round-off
inline constexpr int kPolishSteps = 3;

template <class T>
using Mat4T = Eigen::Matrix<T, 4, 4>;
template <class T>
using Vec4T = Eigen::Matrix<T, 4, 1>;

// Davenport's matrix B of F, with q^T B q = tr(R(q)^T F) for the rotation R(q) of a unit quaternion q.
template <class T>
Mat4T<T> davenport(const Mat3T<T>& F) {
  const Vec3T<T> z = axial<T>(F);
  const T trace = F.trace();
  Mat4T<T> B;
  B(0, 0) = trace;
  for (int i = 0; i < 3; ++i) {
    B(0, i + 1) = B(i + 1, 0) = z[i];
    for (int j = 0; j < 3; ++j) B(i + 1, j + 1) = F(i, j) + F(j, i);
    B(i + 1, i + 1) -= trace;
  }
  return B;
}

// tr(S) for |F| = 1: the largest root of lambda^4 - 2 lambda^2 - 8 d lambda + c with d = det F and c = 1 - 4 |cof F|^2.
// It is accurate enough for polish() to reach round-off.
template <class T>
T largest_eigenvalue(const Mat3T<T>& F) {
  const Vec3T<T> c0 = F.col(1).cross(F.col(2)), c1 = F.col(2).cross(F.col(0)), c2 = F.col(0).cross(F.col(1));
  const T d = F.col(0).dot(c0);
  const T c = T(1) - T(4) * (c0.dot(c0) + c1.dot(c1) + c2.dot(c2));
  T x(1.7320508075688772);  // tr(S) <= sqrt(3) |F|
  for (int i = 0; i < 8; ++i) {
    const T x2 = x * x;
    const T slope = T(4) * x * (x2 - T(1)) - T(8) * d;
    const T value = (x2 - T(2)) * x2 - T(8) * d * x + c;
    const T dx = select(slope > T(1e-9), value / slope, T(0));
    x -= dx;
    if (all(dx * dx < T(1e-12))) break;
  }
  return x;
}

// The column of the adjugate with the largest diagonal entry, for a symmetric 4x4 matrix. If the matrix is singular,
// this is its null vector, not normalised.
template <class T>
Vec4T<T> adjugate_column(const Mat4T<T>& m) {
  const T s0 = m(0, 0) * m(1, 1) - m(1, 0) * m(0, 1), s1 = m(0, 0) * m(1, 2) - m(1, 0) * m(0, 2);
  const T s2 = m(0, 0) * m(1, 3) - m(1, 0) * m(0, 3), s3 = m(0, 1) * m(1, 2) - m(1, 1) * m(0, 2);
  const T s4 = m(0, 1) * m(1, 3) - m(1, 1) * m(0, 3);
  const T c5 = m(2, 2) * m(3, 3) - m(3, 2) * m(2, 3), c4 = m(2, 1) * m(3, 3) - m(3, 1) * m(2, 3);
  const T c3 = m(2, 1) * m(3, 2) - m(3, 1) * m(2, 2), c2 = m(2, 0) * m(3, 3) - m(3, 0) * m(2, 3);
  const T c1 = m(2, 0) * m(3, 2) - m(3, 0) * m(2, 2), c0 = m(2, 0) * m(3, 1) - m(3, 0) * m(2, 1);
  Mat4T<T> A;
  A(0, 0) = m(1, 1) * c5 - m(1, 2) * c4 + m(1, 3) * c3;
  A(1, 0) = -m(1, 0) * c5 + m(1, 2) * c2 - m(1, 3) * c1;
  A(2, 0) = m(1, 0) * c4 - m(1, 1) * c2 + m(1, 3) * c0;
  A(3, 0) = -m(1, 0) * c3 + m(1, 1) * c1 - m(1, 2) * c0;
  A(1, 1) = m(0, 0) * c5 - m(0, 2) * c2 + m(0, 3) * c1;
  A(2, 1) = -m(0, 0) * c4 + m(0, 1) * c2 - m(0, 3) * c0;
  A(3, 1) = m(0, 0) * c3 - m(0, 1) * c1 + m(0, 2) * c0;
  A(2, 2) = m(3, 0) * s4 - m(3, 1) * s2 + m(3, 3) * s0;
  A(3, 2) = -m(3, 0) * s3 + m(3, 1) * s1 - m(3, 2) * s0;
  A(3, 3) = m(2, 0) * s3 - m(2, 1) * s1 + m(2, 2) * s0;
  A(0, 1) = A(1, 0), A(0, 2) = A(2, 0), A(0, 3) = A(3, 0);
  A(1, 2) = A(2, 1), A(1, 3) = A(3, 1), A(2, 3) = A(3, 2);
  Vec4T<T> q = A.col(0);
  T largest = A(0, 0) * A(0, 0);
  for (int k = 1; k < 4; ++k) {
    const T size = A(k, k) * A(k, k);
    const auto larger = size > largest;
    for (int i = 0; i < 4; ++i) q[i] = select(larger, A(i, k), q[i]);
    largest = select(larger, size, largest);
  }
  return q;
}

// The rotation of a quaternion (w, x, y, z) of any length.
template <class T>
Mat3T<T> rotation(const Vec4T<T>& q) {
  const T s = T(2) / (q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3]);
  const T w = q[0], x = q[1], y = q[2], z = q[3];
  Mat3T<T> R;
  R(0, 0) = T(1) - s * (y * y + z * z);
  R(1, 1) = T(1) - s * (x * x + z * z);
  R(2, 2) = T(1) - s * (x * x + y * y);
  R(0, 1) = s * (x * y - w * z);
  R(1, 0) = s * (x * y + w * z);
  R(0, 2) = s * (x * z + w * y);
  R(2, 0) = s * (x * z - w * y);
  R(1, 2) = s * (y * z - w * x);
  R(2, 1) = s * (y * z + w * x);
  return R;
}

// Sets S, G^-1 and det G from A = R^T F; returns G.
template <class T>
Mat3T<T> set_stretch(const Mat3T<T>& A, Polar<T>& p) {
  p.S = symmetric_part<T>(A);
  Mat3T<T> G = -p.S;
  const T trace = p.S.trace();
  for (int i = 0; i < 3; ++i) G(i, i) += trace;
  p.G_inverse = cofactor_of_symmetric<T>(G);
  p.det_G = G(0, 0) * p.G_inverse(0, 0) + G(0, 1) * p.G_inverse(0, 1) + G(0, 2) * p.G_inverse(0, 2);
  p.G_inverse *= T(1) / p.det_G;
  return G;
}

// R <- R cay(w), the Cayley transform of the rotation vector w, with an error of third order in w.
template <class T>
void turn(Mat3T<T>& R, const Vec3T<T>& w) {
  const Vec3T<T> h = T(0.5) * w;
  const T factor = T(2) / (T(1) + h[0] * h[0] + h[1] * h[1] + h[2] * h[2]);
  const Mat3T<T> H = cross_matrix<T>(h);
  const Mat3T<T> step = H + H * H;
  R += factor * (R * step).eval();
}

// Improves p.R by Newton steps, for |F| = 1. Returns the mask of lanes in which the result is the maximiser.
template <class T>
auto polish(const Mat3T<T>& F, Polar<T>& p) {
  for (int i = 0;; ++i) {
    const Mat3T<T> A = p.R.transpose() * F;
    const Vec3T<T> a = axial<T>(A);
    const Mat3T<T> G = set_stretch<T>(A, p);
    const T residual = a[0] * a[0] + a[1] * a[1] + a[2] * a[2];
    const auto definite = (G(0, 0) > T(0)) & (G(0, 0) * G(1, 1) - G(0, 1) * G(0, 1) > T(0)) & (p.det_G > T(kSingularG));
    if (i == kPolishSteps || all(residual <= T(kRotationTolerance * kRotationTolerance)))
      return definite & (residual <= T(kAcceptTolerance * kAcceptTolerance));
    turn<T>(p.R, p.G_inverse * a);
  }
}

// Decomposes F. Precondition: |F| = 1. Returns the mask of lanes that are exact to round-off.
template <class T>
auto decompose_unit(const Mat3T<T>& F, Polar<T>& p) {
  Mat4T<T> B = davenport<T>(F);
  const T lambda = largest_eigenvalue<T>(F);
  for (int i = 0; i < 4; ++i) B(i, i) -= lambda;
  p.R = rotation<T>(adjugate_column<T>(B));
  return polish<T>(F, p);
}

// Decomposes F near a rotation by X <- X (I + E/2 + 3 E^2/8) with E = I - X^T X from X = F, the first terms of
// X (X^T X)^(-1/2) (Higham 2008, Functions of Matrices, sect. 8.6): |E| becomes 5/8 |E|^3, and no division is needed.
// Returns false, with p invalid, unless |E| <= 1/2 and det F > 0 in all lanes. `good`: lanes exact to round-off.
template <class T, class Mask>
bool decompose_near_rotation(const Mat3T<T>& F, Polar<T>& p, Mask& good) {
  constexpr double kFarthest = 0.5, kLast = 1e-5;  // bounds on |E| at the first and at the last step
  constexpr int kMostSteps = 6;
  const T det = F.col(0).dot(F.col(1).cross(F.col(2)));
  p.R = F;
  for (int i = 0;; ++i) {
    Mat3T<T> E;  // upper triangle
    T size(0);
    for (int k = 0; k < 3; ++k)
      for (int j = 0; j <= k; ++j) {
        E(j, k) = T(j == k ? 1 : 0) - (p.R(0, j) * p.R(0, k) + p.R(1, j) * p.R(1, k) + p.R(2, j) * p.R(2, k));
        size += T(j == k ? 1 : 2) * E(j, k) * E(j, k);
      }
    if (i == 0 && !all((size <= T(kFarthest * kFarthest)) & (det > T(0)))) return false;
    const auto times_E = [&](const Vec3T<T>& x) {
      return Vec3T<T>(x[0] * E(0, 0) + x[1] * E(0, 1) + x[2] * E(0, 2),
                      x[0] * E(0, 1) + x[1] * E(1, 1) + x[2] * E(1, 2),
                      x[0] * E(0, 2) + x[1] * E(1, 2) + x[2] * E(2, 2));
    };
    for (int j = 0; j < 3; ++j) {
      const Vec3T<T> xE = times_E({p.R(j, 0), p.R(j, 1), p.R(j, 2)}), xEE = times_E(xE);
      for (int k = 0; k < 3; ++k) p.R(j, k) += T(0.5) * xE[k] + T(0.375) * xEE[k];
    }
    if (i == kMostSteps || all(size <= T(kLast * kLast))) break;
  }
  const Mat3T<T> A = p.R.transpose().lazyProduct(F);
  const Vec3T<T> a = axial<T>(A);
  set_stretch<T>(A, p);
  good = a[0] * a[0] + a[1] * a[1] + a[2] * a[2] <= T(kAcceptTolerance * kAcceptTolerance);
  return true;
}

template <class T>
void scale(Polar<T>& p, const T& factor) {
  p.S *= factor;
  p.G_inverse *= T(1) / factor;
  p.det_G *= factor * factor * factor;
}

}  // namespace polar_detail

}  // namespace orthodyn
