// The common base of laws that rotate with the material: objective viscous stress, and output at a point. The polar
// decomposition is F = R S with G = tr(S) I - S (polar.h); [c] and a() are those of axial.h.
//
// Stiffness-proportional damping acts on the rate of the strain S - I, so that a rigid motion dissipates nothing. With
// dS the rate of S and beta the damping (s), its potential is beta chi dS:C:dS / 2 and its stress is P = R (s + [c])
// with s = beta chi C:dS and G c = a(S s). As G becomes singular, dS is unbounded and chi (blend.h) tends to zero.
#pragma once

#include "lib/element/blend.h"
#include "lib/element/observation.h"
#include "lib/element/polar.h"
#include "lib/element/strain.h"
#include "lib/element/volume_strain.h"

namespace orthodyn {

// The change dS of S for the change dF of F.
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

// Law derives from RotatingLaw<Law, C> and has stress(H, Q). Arguments and `good` as in corotational_law.h.
template <class Law, class C>
class RotatingLaw {
 public:
  explicit RotatingLaw(const C& stiffness) : C_(stiffness) {}

  // Energy per volume, J/m^3.
  template <class Axes>
  ORTHODYN_FLATTEN Batch batch_energy(const Mat3T<Batch>& H, const Axes& Q, Batch::Mask& good) const {
    Polar<Batch> p;
    good = regular_polar(H, Q, p);
    const Mat3T<Batch> e = stretch_strain<Batch>(H, Q, p.S);
    return Batch(0.5) * contract<Batch>(C_.stress(e), e);
  }

  // The strain S - I.
  template <class Axes>
  ORTHODYN_FLATTEN Mat3T<Batch> batch_strain(const Mat3T<Batch>& H, const Axes& Q, Batch::Mask& good) const {
    Polar<Batch> p;
    good = regular_polar(H, Q, p);
    return stretch_strain<Batch>(H, Q, p.S);
  }

  // Dissipated power per volume, beta chi dS:C:dS with the rate dS of S, W/m^3.
  double dissipation(const Mat3& H, const Mat3& Q, const Mat3& F_rate, double beta) const {
    const auto p = polar(deformation_gradient<double>(H, Q), Q);
    const double chi = blend<double>(p.S, p.det_G).chi;
    return contract<double>(viscous_stress<double>(p, C_, beta * chi, F_rate), F_rate);
  }

  template <class Axes>
  ORTHODYN_FLATTEN Batch batch_dissipation(const Mat3T<Batch>& H, const Axes& Q, const Mat3T<Batch>& F_rate,
                                           double beta, Batch::Mask& good) const {
    Polar<Batch> p;
    good = regular_polar(H, Q, p);
    return contract<Batch>(viscous_stress<Batch>(p, C_, Batch(beta), F_rate), F_rate);
  }

  static constexpr bool kHasVolumeCurvature = true;
  template <class T, class Axes>
  ORTHODYN_FLATTEN VolumeStrain<T> volume_strain(const Mat3T<T>& H, const Axes& Q) const {
    return volume_change<T>(H, Q);
  }
  Mat3 mean_volume_gradient(const Mat3& H0, const Mat3& H1, const Mat3& Q) const {
    return orthodyn::mean_volume_gradient(H0, H1, Q);
  }

  PointObservation observe(const Mat3& H, const Mat3& Q) const {
    const Mat3 F = deformation_gradient<double>(H, Q);
    const auto p = polar(F, Q);
    const Mat3 P = static_cast<const Law&>(*this).template stress<double>(H, Q);
    return {cauchy_stress(P, F), p.R, stretch_strain<double>(H, Q, p.S)};
  }

  // `good` is false in lanes with det F <= 0.
  template <class Axes>
  ORTHODYN_FLATTEN PointObservationOf<Batch> batch_observe(const Mat3T<Batch>& H, const Axes& Q,
                                                           Batch::Mask& good) const {
    const Mat3T<Batch> F = deformation_gradient<Batch>(H, Q);
    const Mat3T<Batch> P = static_cast<const Law&>(*this).batch_stress(H, Q, nullptr, 0, good);
    Polar<Batch> p;
    const Batch det_F = F.determinant();
    good = good & regular_polar(H, Q, p) & (det_F > Batch(0));
    return {symmetric_part<Batch>(P * F.transpose()) / det_F, p.R, stretch_strain<Batch>(H, Q, p.S)};
  }

 protected:
  // Sets p. Returns the mask of lanes in which p is valid and the state is regular (blend.h).
  template <class Axes>
  static Batch::Mask regular_polar(const Mat3T<Batch>& H, const Axes& Q, Polar<Batch>& p) {
    const Batch::Mask good = polar(deformation_gradient<Batch>(H, Q), p);
    return good & is_regular<Batch>(p.S, p.det_G);
  }

  C C_;
};

}  // namespace orthodyn
