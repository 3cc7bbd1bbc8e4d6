// The elasticity tensor C at a point, in the material's own axes: sigma = C : e.
//
// Voigt order 11, 22, 33, 12, 23, 31 with engineering shear (gamma_ij = 2 e_ij), as in Li & Barbic
// (2014) eq. (1)-(2). Units: Pa. Each form stores only what it needs.
#pragma once

#include <variant>

#include "lib/core/types.h"

namespace orthodyn {

// sigma = lambda tr(e) I + 2 mu e
struct IsotropicStiffness {
  static constexpr bool kIsotropic = true;
  double lambda = 0, mu = 0;

  template <class T>
  Mat3T<T> stress(const Mat3T<T>& e) const {
    Mat3T<T> s = T(2 * mu) * e;
    const T volumetric = T(lambda) * e.trace();
    for (int i = 0; i < 3; ++i) s(i, i) += volumetric;
    return s;
  }
};

// Nine constants: normal and shear parts decoupled.
struct OrthotropicStiffness {
  static constexpr bool kIsotropic = false;
  double c11 = 0, c22 = 0, c33 = 0, c12 = 0, c23 = 0, c31 = 0;
  double g12 = 0, g23 = 0, g31 = 0;

  template <class T>
  Mat3T<T> stress(const Mat3T<T>& e) const {
    Mat3T<T> s;
    s(0, 0) = c11 * e(0, 0) + c12 * e(1, 1) + c31 * e(2, 2);
    s(1, 1) = c12 * e(0, 0) + c22 * e(1, 1) + c23 * e(2, 2);
    s(2, 2) = c31 * e(0, 0) + c23 * e(1, 1) + c33 * e(2, 2);
    s(0, 1) = s(1, 0) = (2 * g12) * e(0, 1);
    s(1, 2) = s(2, 1) = (2 * g23) * e(1, 2);
    s(2, 0) = s(0, 2) = (2 * g31) * e(2, 0);
    return s;
  }
};

OrthotropicStiffness operator+(const OrthotropicStiffness& a, const OrthotropicStiffness& b);
OrthotropicStiffness operator*(double factor, const OrthotropicStiffness& c);

using Stiffness = std::variant<IsotropicStiffness, OrthotropicStiffness>;

OrthotropicStiffness as_orthotropic(const IsotropicStiffness& c);
inline const OrthotropicStiffness& as_orthotropic(const OrthotropicStiffness& c) { return c; }

// The 6x6 Voigt matrix.
Mat6 voigt(const OrthotropicStiffness& c);

// The isotropic tensor nearest to c in the Euclidean norm of fourth-order tensors (Fedorov 1968):
// kappa = C_iijj / 9, mu = (C_ijij - C_iijj / 3) / 10.
IsotropicStiffness nearest_isotropic(const OrthotropicStiffness& c);

// Matrix K with sigma' = K sigma for sigma' = Q sigma Q^T, where the columns of Q are the material
// axes: then C' = K C K^T (Li & Barbic 2014, section 3).
Mat6 stress_rotation(const Mat3& Q);

}  // namespace orthodyn
