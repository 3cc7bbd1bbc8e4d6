// The weight chi that keeps an anisotropic corotational energy continuously differentiable through inversion:
//     Psi = chi W + (1 - chi) W_iso,   chi = q^3 (10 - 15 q + 6 q^2),   q = det G / (g0 + c min(det F, 0)^2),
// with q clamped to [0, 1], F = R S (polar.h), G = tr(S) I - S, g0 = kBlendG0 and c = kBlendInversion. W and W_iso are
// the energies of the strain S - I for the stiffness and for the isotropic stiffness nearest to it. Where R is not
// unique (det G = 0), W is multi-valued and its force grows like 1/det G, but W_iso is single-valued. Regular states
// (det F >= 0, det G >= g0) have chi = 1; det G = 8 at rest. det G and det F are polynomials in S, so chi is
// continuously differentiable and Psi is an energy.
#pragma once

#include "lib/element/axial.h"

namespace orthodyn {

inline constexpr double kBlendG0 = 0.2, kBlendInversion = 8;

template <class T>
struct Blend {
  T chi = T(1);
  Mat3T<T> gradient = Mat3T<T>::Zero();  // dchi/dS, symmetric
};

// The mask of lanes with det F >= 0 and det G >= g0, where chi = 1.
template <class T>
auto is_regular(const Mat3T<T>& S, const T& det_G) {
  const Mat3T<T> cof = cofactor_of_symmetric<T>(S);
  const T det_F = S(0, 0) * cof(0, 0) + S(0, 1) * cof(0, 1) + S(0, 2) * cof(0, 2);
  return (det_F >= T(0)) & (det_G >= T(kBlendG0));
}

template <class T>
Blend<T> blend(const Mat3T<T>& S, const T& det_G) {
  using std::real;
  const Mat3T<T> cof = cofactor_of_symmetric(S);
  const T det_F = S(0, 0) * cof(0, 0) + S(0, 1) * cof(0, 1) + S(0, 2) * cof(0, 2);
  const bool inverted = real(det_F) < 0;
  const T negative = inverted ? det_F : T(0);
  const T scale = T(kBlendG0) + kBlendInversion * negative * negative;
  Blend<T> b;
  if (real(det_G) >= real(scale)) return b;
  const T q = real(det_G) > 0 ? det_G / scale : T(0);
  b.chi = q * q * q * (T(10) + q * (T(-15) + T(6) * q));
  const T slope = T(30) * q * q * (T(1) - q) * (T(1) - q);
  const T trace = S.trace();
  const Mat3T<T> dG = trace * trace * Mat3T<T>::Identity() - S * S;  // d det G / dS
  b.gradient = (slope / scale) * (dG - (q * T(2 * kBlendInversion) * negative) * cof);
  return b;
}

}  // namespace orthodyn
