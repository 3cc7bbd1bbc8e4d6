// What the laws that rotate with the material have in common: objective viscous stress, and what can
// be observed at a point.
//
// Stiffness-proportional damping acts on the rate of the strain measure itself, so that a rigid
// motion dissipates nothing: potential beta chi dS:C:dS / 2, P = R (s + [c]), s = beta chi C:dS, G c = a(S s). As
// G becomes singular dS grows without bound, and chi (blend.h) takes it to zero.
#pragma once

#include "lib/element/blend.h"
#include "lib/element/observation.h"
#include "lib/element/polar.h"
#include "lib/element/strain.h"

namespace orthodyn {

// dS for a change dF of F.
template <class T>
Mat3T<T> stretch_change(const Polar<T>& p, const Mat3T<T>& dF) {
  const Mat3T<T> X = p.R.transpose() * dF;
  const Vec3T<T> w = p.G_inverse * axial<T>(X);
  return symmetric_part<T>(X - cross_matrix<T>(w) * p.S);
}

template <class T, class C>
Mat3T<T> viscous_stress(const Polar<T>& p, const C& stiffness, const T& beta_chi, const Mat3T<T>& F_rate) {
  const Mat3T<T> s = beta_chi * stiffness.stress(stretch_change<T>(p, F_rate));
  const Vec3T<T> c = p.G_inverse * axial<T>(p.S * s);
  return p.R * (s + cross_matrix<T>(c));
}

// Law derives from RotatingLaw<Law, C> and has stress(H, Q); arguments as in corotational_law.h.
template <class Law, class C>
class RotatingLaw {
 public:
  explicit RotatingLaw(const C& stiffness) : C_(stiffness) {}

  // Energy per volume of a batch; right in the lanes of `good`.
  template <class Axes>
  ORTHODYN_FLATTEN Batch batch_energy(const Mat3T<Batch>& H, const Axes& Q, Batch::Mask& good) const {
    Polar<Batch> p;
    good = regular_polar(H, Q, p);
    const Mat3T<Batch> e = stretch_strain<Batch>(H, Q, p.S);
    return Batch(0.5) * contract<Batch>(C_.stress(e), e);
  }

  // S - I of a batch, right in the lanes of `good`.
  template <class Axes>
  ORTHODYN_FLATTEN Mat3T<Batch> batch_strain(const Mat3T<Batch>& H, const Axes& Q, Batch::Mask& good) const {
    Polar<Batch> p;
    good = regular_polar(H, Q, p);
    return stretch_strain<Batch>(H, Q, p.S);
  }

  // Power per volume that damping takes, beta chi dS:C:dS, W/m^3.
  double dissipation(const Mat3& H, const Mat3& Q, const Mat3& F_rate, double beta) const {
    const auto p = polar(deformation_gradient<double>(H, Q), Q);
    const double chi = blend<double>(p.S, p.det_G).chi;
    return contract<double>(viscous_stress<double>(p, C_, beta * chi, F_rate), F_rate);
  }

  // The same for a batch; right in the lanes of `good`.
  template <class Axes>
  ORTHODYN_FLATTEN Batch batch_dissipation(const Mat3T<Batch>& H, const Axes& Q, const Mat3T<Batch>& F_rate,
                                           double beta, Batch::Mask& good) const {
    Polar<Batch> p;
    good = regular_polar(H, Q, p);
    return contract<Batch>(viscous_stress<Batch>(p, C_, Batch(beta), F_rate), F_rate);
  }

  PointObservation observe(const Mat3& H, const Mat3& Q) const {
    const Mat3 F = deformation_gradient<double>(H, Q);
    const auto p = polar(F, Q);
    const Mat3 P = static_cast<const Law&>(*this).template stress<double>(H, Q);
    return {cauchy_stress(P, F), p.R, stretch_strain<double>(H, Q, p.S)};
  }

 protected:
  // The mask of regular lanes.
  template <class Axes>
  static Batch::Mask regular_polar(const Mat3T<Batch>& H, const Axes& Q, Polar<Batch>& p) {
    const Batch::Mask good = polar(deformation_gradient<Batch>(H, Q), p);
    return good & is_regular<Batch>(p.S, p.det_G);
  }

  C C_;
};

}  // namespace orthodyn
