// The volume strain theta at a point: J - 1 with J = det F for large deformation, tr(H) for small strain.
#pragma once

#include "lib/element/strain.h"

namespace orthodyn {

// For one point (T = double) or a batch.
template <class T>
struct VolumeStrain {
  T value;
  Mat3T<T> gradient;  // with respect to F, in material axes: cof(F) Q, or Q for small strain
  Mat3T<T> F;         // in material axes; Q for small strain
};

// The matrix of cofactors, det(A) A^-T.
template <class T>
Mat3T<T> cofactors(const Mat3T<T>& A) {
  Mat3T<T> out;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) {
      const int k = (i + 1) % 3, l = (i + 2) % 3, m = (j + 1) % 3, n = (j + 2) % 3;
      out(i, j) = A(k, m) * A(l, n) - A(k, n) * A(l, m);
    }
  return out;
}

// J - 1 = tr(H) + tr(cof H) + det H, without the cancellation of det(F) - 1. Arguments as in strain.h.
template <class T, class Axes>
VolumeStrain<T> volume_change(const Mat3T<T>& H, const Axes& Q) {
  const Mat3T<T> in_space = H * Q.transpose().template cast<T>(), cof_H = cofactors<T>(in_space);
  T det_H = in_space(0, 0) * cof_H(0, 0);
  for (int j = 1; j < 3; ++j) det_H += in_space(0, j) * cof_H(0, j);
  const Mat3T<T> F = deformation_gradient<T>(H, Q);
  return {in_space.trace() + cof_H.trace() + det_H, cofactors<T>(F), F};
}

// D with D : (F1 - F0) = J1 - J0 and D (F0 + F1)^T symmetric, in material axes: a force with this gradient conserves
// energy and angular momentum. With C = F^T F, a = (C0 + C1) / 2 and d = C1 - C0,
//     J1^2 - J0^2 = det C1 - det C0 = (cof a + cof d / 12) : d   and   d = 2 sym(((F0 + F1) / 2)^T (F1 - F0)).
// Precondition: J0, J1 > 0.
inline Mat3 mean_volume_gradient(const Mat3& H0, const Mat3& H1, const Mat3& Q) {
  const Mat3 F0 = deformation_gradient<double>(H0, Q), F1 = deformation_gradient<double>(H1, Q);
  const Mat3 C0 = F0.transpose() * F0, C1 = F1.transpose() * F1;
  const Mat3 slope = cofactors<double>(0.5 * (C0 + C1)) + cofactors<double>(C1 - C0) / 12;
  return (F0 + F1) * slope / (F0.determinant() + F1.determinant());
}

// Adds s times the second derivative of J with respect to the nodes 1, 2, ... to their blocks. In the directions u (x)
// g and v (x) h it is (u x v) . F (g x h). `point.B` and `F` are in material axes; `V_s` is the point's volume times s.
template <int kNodes, class T, class Point, class Blocks>
void add_volume_curvature(const Mat3T<T>& F, const T& V_s, const Point& point, bool symmetric, Blocks& blocks) {
  const Mat3T<T> scaled = V_s * F;
  for (int b = 0; b < kNodes - 1; ++b)
    for (int a = symmetric ? b + 1 : 0; a < kNodes - 1; ++a) {
      if (a == b) continue;
      const Vec3T<T> g = point.B.row(a), h = point.B.row(b);
      const Vec3T<T> w = scaled * Vec3T<T>(g.cross(h));
      auto& block = blocks[static_cast<std::size_t>(a) + 1][static_cast<std::size_t>(b) + 1];
      for (int i = 0; i < 3; ++i) {
        const int j = (i + 1) % 3, k = (i + 2) % 3;
        block(i, j) += w[k];
        block(j, i) -= w[k];
      }
    }
}

}  // namespace orthodyn
