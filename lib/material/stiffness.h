// The elasticity tensor C at a point, in the material's own axes: sigma = C : e.
//
// Voigt order 11, 22, 33, 12, 23, 31 with engineering shear (gamma_ij = 2 e_ij), as in Li & Barbic
// (2014) eq. (1)-(2). Units: Pa. Each form stores only what it needs.
#pragma once

#include <type_traits>
#include <utility>
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

// Nine constants, as normal and shear strains are decoupled.
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

// All 21 constants.
struct AnisotropicStiffness {
  static constexpr bool kIsotropic = false;
  Mat6 c = Mat6::Zero();  // symmetric, in the Voigt order above

  template <class T>
  Mat3T<T> stress(const Mat3T<T>& e) const {
    const T strain[6] = {e(0, 0), e(1, 1), e(2, 2), T(2.0) * e(0, 1), T(2.0) * e(1, 2), T(2.0) * e(2, 0)};
    T sigma[6];
    for (int i = 0; i < 6; ++i) {
      sigma[i] = c(i, 0) * strain[0];
      for (int j = 1; j < 6; ++j) sigma[i] += c(i, j) * strain[j];
    }
    Mat3T<T> s;
    s << sigma[0], sigma[3], sigma[5], sigma[3], sigma[1], sigma[4], sigma[5], sigma[4], sigma[2];
    return s;
  }
};

// Precondition: young > 0, -1 < nu < 1/2.
inline IsotropicStiffness isotropic_stiffness(double young, double nu) {
  return {young * nu / ((1 + nu) * (1 - 2 * nu)), young / (2 * (1 + nu))};
}

OrthotropicStiffness operator+(const OrthotropicStiffness& a, const OrthotropicStiffness& b);
OrthotropicStiffness operator*(double factor, const OrthotropicStiffness& c);

AnisotropicStiffness operator+(const AnisotropicStiffness& a, const AnisotropicStiffness& b);
AnisotropicStiffness operator+(const AnisotropicStiffness& a, const OrthotropicStiffness& b);
AnisotropicStiffness operator*(double factor, const AnisotropicStiffness& c);

using Stiffness = std::variant<IsotropicStiffness, OrthotropicStiffness, AnisotropicStiffness>;

OrthotropicStiffness as_orthotropic(const IsotropicStiffness& c);
inline const OrthotropicStiffness& as_orthotropic(const OrthotropicStiffness& c) { return c; }

// The type of C in tangents, chosen so that sums and multiples have the same type.
inline OrthotropicStiffness as_tangent(const IsotropicStiffness& c) { return as_orthotropic(c); }
inline const OrthotropicStiffness& as_tangent(const OrthotropicStiffness& c) { return c; }
inline const AnisotropicStiffness& as_tangent(const AnisotropicStiffness& c) { return c; }
template <class C>
using TangentStiffness = std::decay_t<decltype(as_tangent(std::declval<C>()))>;

// The 6x6 Voigt matrix.
Mat6 voigt(const IsotropicStiffness& c);
Mat6 voigt(const OrthotropicStiffness& c);
inline const Mat6& voigt(const AnisotropicStiffness& c) { return c.c; }
Mat6 voigt(const Stiffness& c);

// The isotropic tensor nearest to c in the Euclidean norm of fourth-order tensors (Fedorov 1968):
// kappa = C_iijj / 9, mu = (C_ijij - C_iijj / 3) / 10.
IsotropicStiffness nearest_isotropic(const OrthotropicStiffness& c);
IsotropicStiffness nearest_isotropic(const AnisotropicStiffness& c);

// The bulk modulus kappa = 1 / (I : S : I), Pa, with the compliance S. A pressure p changes the volume by the fraction
// -p / kappa; the shape of an anisotropic body changes, too (Vergori, Destrade, McGarry & Ogden 2013, Computational
// Mechanics 52, 959).
double bulk_modulus(const Stiffness& c);

// C' = C - kappa I (x) I, positive semidefinite for kappa (Pa) <= bulk_modulus(C). If they are equal, C' : S : I = 0:
// the strain S : I due to pressure has no stress.
IsotropicStiffness without_bulk(IsotropicStiffness c, double kappa);
OrthotropicStiffness without_bulk(OrthotropicStiffness c, double kappa);
AnisotropicStiffness without_bulk(AnisotropicStiffness c, double kappa);

// The 6x6 matrix K that rotates stresses in Voigt form from material axes, the columns of Q, to global axes: K sigma is
// the Voigt form of Q sigma Q^T. The stiffness in global axes is K C K^T (Li & Barbic 2014, section 3).
Mat6 stress_rotation(const Mat3& Q);

}  // namespace orthodyn
