// Strains from the displacement gradient H = F - I, to a few ulp of the larger of strain and rotation.
//
// Laws take H rather than F, since F and its stretch S represent a small strain only to an absolute error of eps. With
// e = S - I and 2 E = F^T F - I,
//     2 E = (I + H/2)^T H + H^T (I + H/2)   and   2 E = S^2 - I = 2 e + e^2   give   e = E - e^2/2,
// where an error of eps in the e on the right becomes an error of eps |e| on the left.
//
// Functions take H and F in material axes: H^ = H Q and F^ = Q + H^. Q is one rotation (Mat3), or one per lane
// (Mat3T<Batch>).
#pragma once

#include "lib/element/axial.h"
#include "lib/element/batch.h"

namespace orthodyn {

template <class T, class Axes>
Mat3T<T> deformation_gradient(const Mat3T<T>& H, const Axes& Q) {
  return Q.template cast<T>() + H;
}

// sym(F) - I in material axes.
template <class T, class Axes>
Mat3T<T> small_strain(const Mat3T<T>& H, const Axes& Q) {
  return symmetric_part<T>(Q.transpose().template cast<T>() * H);
}

// S - I in material axes, for S of the polar decomposition of F.
template <class T, class Axes>
Mat3T<T> stretch_strain(const Mat3T<T>& H, const Axes& Q, const Mat3T<T>& S) {
  using std::real;
  const Mat3T<T> M = (Q.template cast<T>() + T(0.5) * H).transpose() * H, rough = S - Mat3T<T>::Identity();
  const auto size = real(rough.cwiseProduct(rough).sum());
  const auto is_tiny = size < 1e-16, is_small = size < 1;  // for large strains S - I is accurate
  Mat3T<T> E, e, strain;                                   // E: upper triangle only
  for (int i = 0; i < 3; ++i)
    for (int j = i; j < 3; ++j) {
      E(i, j) = T(0.5) * (M(i, j) + M(j, i));
      e(i, j) = e(j, i) = select(is_tiny, E(i, j), rough(i, j));  // used only in e^2
    }
  for (int i = 0; i < 3; ++i)
    for (int j = i; j < 3; ++j) {
      const T precise = E(i, j) - T(0.5) * (e(i, 0) * e(0, j) + e(i, 1) * e(1, j) + e(i, 2) * e(2, j));
      strain(i, j) = strain(j, i) = select(is_small, precise, rough(i, j));
    }
  return strain;
}

}  // namespace orthodyn
