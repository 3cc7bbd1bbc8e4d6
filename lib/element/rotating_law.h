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

namespace orthodyn {

template <class T, class C>
Mat3T<T> viscous_stress(const Polar<T>& p, const C& stiffness, const T& beta_chi, const Mat3T<T>& F_rate) {
  const Mat3T<T> X = p.R.transpose() * F_rate;
  const Vec3T<T> w = p.G_inverse * axial<T>(X);
  const Mat3T<T> rate = symmetric_part<T>(X - cross_matrix<T>(w) * p.S);
  const Mat3T<T> s = beta_chi * stiffness.stress(rate);
  const Vec3T<T> c = p.G_inverse * axial<T>(p.S * s);
  return p.R * (s + cross_matrix<T>(c));
}

// Law derives from RotatingLaw<Law, C> and has stress(F, Q).
template <class Law, class C>
class RotatingLaw {
 public:
  static constexpr bool kBatchesNeedAxes = false;  // F Q tells all but how a tie of the polar decomposition is broken

  explicit RotatingLaw(const C& stiffness) : C_(stiffness) {}

  // Energy per volume of a batch; right in the lanes of `good`.
  Batch batch_energy(const Mat3T<Batch>& F, const Mat3&, Batch::Mask& good) const {
    Polar<Batch> p;
    good = polar(F, p);
    good = good & is_regular<Batch>(p.S, p.det_G);
    const Mat3T<Batch> e = p.S - Mat3T<Batch>::Identity();
    return Batch(0.5) * contract<Batch>(C_.stress(e), e);
  }

  // Power per volume that damping takes, beta chi dS:C:dS, W/m^3.
  double dissipation(const Mat3& F, const Mat3& Q, const Mat3& F_rate, double beta) const {
    const auto p = polar(F, Q);
    const double chi = blend<double>(p.S, p.det_G).chi;
    return contract<double>(viscous_stress<double>(p, C_, beta * chi, F_rate), F_rate);
  }

  // The same for a batch; right in the lanes of `good`.
  Batch batch_dissipation(const Mat3T<Batch>& F, const Mat3&, const Mat3T<Batch>& F_rate, double beta,
                          Batch::Mask& good) const {
    Polar<Batch> p;
    good = polar(F, p);
    good = good & is_regular<Batch>(p.S, p.det_G);
    return contract<Batch>(viscous_stress<Batch>(p, C_, Batch(beta), F_rate), F_rate);
  }

  PointObservation observe(const Mat3& F, const Mat3& Q) const {
    const auto p = polar(F, Q);
    const Mat3 P = static_cast<const Law&>(*this).template stress<double>(F, Q);
    return {cauchy_stress(P, F), p.R, p.S - Mat3::Identity()};
  }

 protected:
  C C_;
};

}  // namespace orthodyn
