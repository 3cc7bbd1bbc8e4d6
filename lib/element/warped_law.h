// The warped-stiffness force: P = R sigma with sigma = C:(S - I) (Mueller & Gross 2004; Li & Barbic 2014; Vega FEM).
//
// For comparison only: for anisotropic C the force has no energy and exerts a net torque. energy() returns W(S - I),
// which is not conserved. The tangent is either R K R^T with the stiffness K at rest (symmetric, approximate) or the
// exact, unsymmetric derivative.
#pragma once

#include "lib/element/corotational_law.h"
#include "lib/element/warped_tangent.h"

namespace orthodyn {

template <class C>
class WarpedLaw : public RotatingLaw<WarpedLaw<C>, C> {
 public:
  static constexpr const char* kName = "WARPED force R sigma (no energy, net torque)";
  static constexpr bool kHasEnergy = false;
  using Form = TangentFormOf<TangentStiffness<C>>;

  WarpedLaw(const C& stiffness, WarpedTangent tangent)
      : RotatingLaw<WarpedLaw, C>(stiffness), exact_(stiffness), tangent_(tangent) {}

  template <class T>
  T energy(const Mat3T<T>& H, const Mat3& Q) const {
    const auto p = polar(deformation_gradient<T>(H, Q), Q);
    const Mat3T<T> e = stretch_strain<T>(H, Q, p.S);
    return T(0.5) * contract<T>(C_.stress(e), e);
  }

  template <class T>
  Mat3T<T> stress(const Mat3T<T>& H, const Mat3& Q, const Mat3T<T>* F_rate = nullptr, double beta = 0) const {
    const auto p = polar(deformation_gradient<T>(H, Q), Q);
    Mat3T<T> P = p.R * C_.stress(stretch_strain<T>(H, Q, p.S));
    if (F_rate) P += viscous_stress<T>(p, C_, T(beta) * blend<T>(p.S, p.det_G).chi, *F_rate);
    return P;
  }

  template <class Axes>
  Mat3T<Batch> batch_stress(const Mat3T<Batch>& H, const Axes& Q, const Mat3T<Batch>* F_rate, double beta,
                            Batch::Mask& good) const {
    Polar<Batch> p;
    good = polar(deformation_gradient<Batch>(H, Q), p);
    if (F_rate) good = good & is_regular<Batch>(p.S, p.det_G);
    Mat3T<Batch> P = p.R * C_.stress(stretch_strain<Batch>(H, Q, p.S));
    if (F_rate) P += viscous_stress<Batch>(p, C_, Batch(beta), *F_rate);
    return P;
  }

  Form tangent(const Mat3& H, const Mat3& Q, TangentKind kind, double beta, Form* damping) const {
    const auto p = polar(deformation_gradient<double>(H, Q), Q);
    if (damping) exact_.tangent(H, Q, TangentKind::gauss_newton, beta, damping);
    return kind == TangentKind::exact && tangent_ == WarpedTangent::unsymmetric && p.det_G > kBlendG0
               ? unsymmetric_form(p, stretch_strain<double>(H, Q, p.S))
               : rotated_form(p);
  }

 private:
  Form rotated_form(const Polar<double>& p) const {
    return {p.R, as_tangent(C_), Mat63::Zero(), Mat36::Zero(), Mat3::Zero()};
  }

  // d(R sigma) = R ([w] sigma + C : dS) with w = G^-1 a and dS = e - sym([w] S); a and e as in tangent_form.h.
  Form unsymmetric_form(const Polar<double>& p, const Mat3& strain) const {
    Form form = gauss_newton_form(p, as_tangent(C_));
    const Mat3 sigma = C_.stress(strain);
    for (int k = 0; k < 3; ++k) {
      const Vec3 w = p.G_inverse.col(k);
      const Mat3 D = symmetric_part<double>(cross_matrix<double>(w) * sigma);
      form.Hea.col(k) += (Vec6() << D(0, 0), D(1, 1), D(2, 2), D(0, 1), D(1, 2), D(2, 0)).finished();
    }
    form.Hae.setZero();
    form.Haa = 0.5 * (sigma.trace() * Mat3::Identity() - sigma) * p.G_inverse;
    return form;
  }

  CorotationalLaw<C> exact_;  // for its damping tangent
  using RotatingLaw<WarpedLaw, C>::C_;
  WarpedTangent tangent_;
};

}  // namespace orthodyn
