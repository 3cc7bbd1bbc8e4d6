// Strains from the displacement gradient H = F - I, to a few ulp of the larger of strain and rotation.
//
// Laws are given H and not F: F, and the stretch S of its polar decomposition, hold a small strain to eps only. With
//     S^2 - I = F^T F - I = (I + H/2)^T H + H^T (I + H/2) = 2 E   and   S^2 - I = 2 e + e^2,   e = S - I,
// e = E - e^2/2: an e with an error of eps on the right gives one with an error of eps |e| on the left.
//
// H is taken in material axes, H^ = H Q, as F is: F^ = Q + H^. Q is one rotation (Mat3), or one for each lane of a
// batch (Mat3T<Batch>).
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

// S - I in material axes, S being that of the polar decomposition of F.
template <class T, class Axes>
Mat3T<T> stretch_strain(const Mat3T<T>& H, const Axes& Q, const Mat3T<T>& S) {
  using std::real;
  const Mat3T<T> M = (Q.template cast<T>() + T(0.5) * H).transpose() * H, rough = S - Mat3T<T>::Identity();
  const auto size = real(rough.cwiseProduct(rough).sum());
  const auto is_tiny = size < 1e-16, is_small = size < 1;  // of large strains S - I loses nothing
  Mat3T<T> E, e, strain;                                   // of E the upper triangle
  for (int i = 0; i < 3; ++i)
    for (int j = i; j < 3; ++j) {
      E(i, j) = T(0.5) * (M(i, j) + M(j, i));
      e(i, j) = e(j, i) = select(is_tiny, E(i, j), rough(i, j));  // in e^2
    }
  for (int i = 0; i < 3; ++i)
    for (int j = i; j < 3; ++j) {
      const T precise = E(i, j) - T(0.5) * (e(i, 0) * e(0, j) + e(i, 1) * e(1, j) + e(i, 2) * e(2, j));
      strain(i, j) = strain(j, i) = select(is_small, precise, rough(i, j));
    }
  return strain;
}

}  // namespace orthodyn
