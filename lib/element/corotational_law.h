// The corotational law at a point: Psi(F) = W(S - I) with F = R S and W(e) = e:C:e / 2.
//
// With the stress sigma = C:(S - I), G = tr(S) I - S and the notation of axial.h, its exact gradient is
//     P = R (sigma + [c])   with   G c = a(S sigma):
// the warped stress R sigma plus a correction that makes P conservative and free of torque for anisotropic C. Inverted
// states are blended into the nearest isotropic law (blend.h). For isotropic C, c = 0 and no blending is needed, so
// neither is computed.
//
// The input is the displacement gradient H = F - I (strain.h) in material axes: H^ = H Q with the axes as columns of Q,
// so that C has its sparse form. Likewise F^ = F Q and P^ = P Q. The law has no state: R is a pure function of F.
//
// Batch functions are valid in the lanes of `good`; the caller evaluates the other lanes (inverted, singular) one by
// one. Batch functions are flattened, because function calls would pass batches through memory.
//
// Derivation of the tangent: with X = R^T dF, w = G^-1 a(X), dS = sym(X) - sym([w] S), T = sigma + [c], tau = T S,
//     d2Psi = dS:C:dS + 2 w . a(dS T^T) + w . (tr(tau) I - tau) w.
// The first term is the Gauss-Newton part.
#pragma once

#include "lib/core/errors.h"
#include "lib/element/lyapunov.h"
#include "lib/element/rotating_law.h"
#include "lib/element/tangent_form.h"

namespace orthodyn {

// The positive semidefinite Gauss-Newton part dS:C:dS, for one point or a batch. Precondition: G is not singular.
template <class C, class T>
TangentFormOf<C, T> gauss_newton_form(const Polar<T>& p, const C& stiffness);

// The whole d2Psi for chi = 1; stress = sigma + [c].
template <class C, class T>
TangentFormOf<C, T> exact_form(const Polar<T>& p, const C& stiffness, const Mat3T<T>& stress);

template <class C>
class CorotationalLaw : public RotatingLaw<CorotationalLaw<C>, C> {
 public:
  static constexpr const char* kName = "corotational, exact gradient";
  static constexpr bool kHasEnergy = true;
  using Form = TangentFormOf<TangentStiffness<C>>;
  using BatchForm = TangentFormOf<TangentStiffness<C>, Batch>;

  explicit CorotationalLaw(const C& stiffness)
      : RotatingLaw<CorotationalLaw, C>(stiffness), sparse_(as_tangent(stiffness)) {
    if constexpr (!C::kIsotropic) isotropic_ = nearest_isotropic(stiffness);
  }

  // Energy per volume, J/m^3.
  template <class T>
  T energy(const Mat3T<T>& H, const Mat3& Q) const {
    const auto p = polar(deformation_gradient<T>(H, Q), Q);
    const Mat3T<T> e = stretch_strain<T>(H, Q, p.S);
    const T W = T(0.5) * contract<T>(C_.stress(e), e);
    if constexpr (C::kIsotropic) {
      return W;
    } else {
      const auto b = blend<T>(p.S, p.det_G);
      return b.chi * W + (T(1) - b.chi) * T(0.5) * contract<T>(isotropic_.stress(e), e);
    }
  }

  // First Piola-Kirchhoff stress times Q, Pa. With F_rate (1/s), adds the viscous stress for the damping beta (s).
  template <class T>
  Mat3T<T> stress(const Mat3T<T>& H, const Mat3& Q, const Mat3T<T>* F_rate = nullptr, double beta = 0) const {
    const auto p = polar(deformation_gradient<T>(H, Q), Q);
    T chi(1);
    Mat3T<T> P = p.R * rotated_stress<T>(p, stretch_strain<T>(H, Q, p.S), chi);
    if (F_rate) P += viscous_stress<T>(p, C_, damping_weight(p, chi, T(beta)), *F_rate);
    return P;
  }

  template <class Axes>
  ORTHODYN_FLATTEN Mat3T<Batch> batch_stress(const Mat3T<Batch>& H, const Axes& Q, const Mat3T<Batch>* F_rate,
                                             double beta, Batch::Mask& good) const {
    Polar<Batch> p;
    good = this->regular_polar(H, Q, p);
    Mat3T<Batch> P = p.R * regular_stress<Batch>(p, stretch_strain<Batch>(H, Q, p.S));
    if (F_rate) P += viscous_stress<Batch>(p, C_, Batch(beta), *F_rate);
    return P;
  }

  // Returns the elastic tangent and, unless `damping` is null, sets the damping tangent dP/dF_rate. In blended states
  // both kinds of tangent are positive semidefinite approximations, since the Hessian is unbounded there.
  Form tangent(const Mat3& H, const Mat3& Q, TangentKind kind, double beta, Form* damping) const {
    const auto p = polar(deformation_gradient<double>(H, Q), Q);
    const auto b = blend<double>(p.S, p.det_G);
    if (damping) *damping = weighted_form(p, beta * sparse_, b.chi);
    if (b.chi < 1) return blended_form(p, b.chi);
    if (kind == TangentKind::gauss_newton) return gauss_newton_form(p, sparse_);
    return exact_form(p, sparse_, regular_stress<double>(p, stretch_strain<double>(H, Q, p.S)));
  }

  template <class Axes>
  BatchForm batch_tangent(const Mat3T<Batch>& H, const Axes& Q, TangentKind kind, double beta, BatchForm* damping,
                          Batch::Mask& good) const {
    Polar<Batch> p;
    good = this->regular_polar(H, Q, p);
    if (damping) *damping = gauss_newton_form(p, beta * sparse_);
    if (kind == TangentKind::gauss_newton) return gauss_newton_form(p, sparse_);
    return exact_form(p, sparse_, regular_stress<Batch>(p, stretch_strain<Batch>(H, Q, p.S)));
  }

  // The exact tangent at H, with the stress at H replaced by its prediction C:(S0 - I + dS) from the state H0, where dS
  // is linear in F - F0. This is the tangent of Newton's method with independent stress unknowns (Magisano, Leonetti &
  // Garcea, CMAME 313, 2017). It excludes the spurious stress of a straight Newton step, which stretches a body that
  // bends. Returns tangent() at H if either state is blended.
  Form predicted_tangent(const Mat3& H0, const Mat3& H, const Mat3& Q) const {
    const Mat3 F0 = deformation_gradient<double>(H0, Q), F = deformation_gradient<double>(H, Q);
    const auto p0 = polar(F0, Q), p = polar(F, Q);
    for (const auto* end : {&p0, &p})
      if (blend<double>(end->S, end->det_G).chi < 1) return tangent(H, Q, TangentKind::exact, 0, nullptr);
    const Mat3 sigma = C_.stress(Mat3(stretch_strain<double>(H0, Q, p0.S) + stretch_change<double>(p0, F - F0)));
    const Vec3 c = p.G_inverse * axial<double>(p.S * sigma);
    return exact_form(p, sparse_, Mat3(sigma + cross_matrix<double>(c)));
  }

  // The stress P Q between two states with P : (F1 - F0) = Psi(F1) - Psi(F0), which conserves energy, and P (F0 + F1)^T
  // symmetric, which conserves angular momentum. P = (F0 + F1)/2 X with symmetric X is the discrete derivative with
  // respect to F^T F (Simo & Tarnow 1992; Gonzalez 2000). X needs no difference quotient, because Psi is quadratic in S
  // and S^2 = F^T F. With the means s of S and sigma of the stresses,
  //     Psi1 - Psi0 = sigma : (S1 - S0)   and   s (S1 - S0) + (S1 - S0) s = S1^2 - S0^2   give   s X + X s = 2 sigma.
  // Throws RecoverableError if either state is inverted or blended, because F^T F does not depend on the sign of det F.
  Mat3 mean_stress(const Mat3& H0, const Mat3& H1, const Mat3& Q) const {
    const auto p0 = polar(deformation_gradient<double>(H0, Q), Q), p1 = polar(deformation_gradient<double>(H1, Q), Q);
    for (const auto* p : {&p0, &p1})
      if (!(p->S.determinant() > 0) || !is_regular<double>(p->S, p->det_G))
        throw RecoverableError(
            "an element is inverted or flat; the force of energy-conserving steps is undefined there");
    return mean_stress_between<double>(H0, p0, H1, p1, Q);
  }

  template <class Axes>
  ORTHODYN_FLATTEN Mat3T<Batch> batch_mean_stress(const Mat3T<Batch>& H0, const Mat3T<Batch>& H1, const Axes& Q,
                                                  Batch::Mask& good) const {
    Polar<Batch> p0, p1;
    good = this->regular_polar(H0, Q, p0) & this->regular_polar(H1, Q, p1);
    good = good & (p0.S.determinant() > Batch(0)) & (p1.S.determinant() > Batch(0));
    return mean_stress_between<Batch>(H0, p0, H1, p1, Q);
  }

  // The stress in the rotated frame, T = sigma + [c] with P = R T, for chi = 1; e = S - I.
  template <class T>
  Mat3T<T> regular_stress(const Polar<T>& p, const Mat3T<T>& e) const {
    const Mat3T<T> sigma = C_.stress(e);
    if constexpr (C::kIsotropic) {
      return sigma;
    } else {
      const Vec3T<T> c = p.G_inverse * axial<T>(e * sigma);  // = a(S sigma), as a(sigma) = 0
      return sigma + cross_matrix<T>(c);
    }
  }

  // As regular_stress(), but for any state. Sets chi if C is anisotropic.
  template <class T>
  Mat3T<T> rotated_stress(const Polar<T>& p, const Mat3T<T>& e, T& chi) const {
    if constexpr (C::kIsotropic) {
      return regular_stress<T>(p, e);
    } else {
      const auto b = blend<T>(p.S, p.det_G);
      chi = b.chi;
      if (std::real(chi) == 1) return regular_stress<T>(p, e);
      const Mat3T<T> sigma_iso = isotropic_.stress(e);
      const T excess = T(0.5) * contract<T>(Mat3T<T>(C_.stress(e) - sigma_iso), e);
      return chi * regular_stress<T>(p, e) + (T(1) - chi) * sigma_iso + excess * b.gradient;
    }
  }

 private:
  template <class T, class Axes>
  Mat3T<T> mean_stress_between(const Mat3T<T>& H0, const Polar<T>& p0, const Mat3T<T>& H1, const Polar<T>& p1,
                               const Axes& Q) const {
    const Mat3T<T> S = T(0.5) * (p0.S + p1.S);
    const Mat3T<T> strains = stretch_strain<T>(H0, Q, p0.S) + stretch_strain<T>(H1, Q, p1.S);  // twice their mean
    return deformation_gradient<T>(T(0.5) * (H0 + H1), Q) * solve_lyapunov<T>(S, C_.stress(strains));
  }

  // Returns beta chi, also for isotropic laws: their energy is not blended, but dS/dF is unbounded where G is singular.
  template <class T>
  T damping_weight(const Polar<T>& p, const T& chi, const T& beta) const {
    if constexpr (C::kIsotropic) return beta * blend<T>(p.S, p.det_G).chi;
    else return beta * chi;
  }

  // chi times the Gauss-Newton form.
  static Form weighted_form(const Polar<double>& p, const TangentStiffness<C>& stiffness, double chi) {
    if (chi > 0) return gauss_newton_form(p, chi * stiffness);
    return {p.R, {}, Mat63::Zero(), Mat36::Zero(), Mat3::Zero()};  // G may be singular
  }

  // chi times the Gauss-Newton part plus 1 - chi times the isotropic law at fixed rotation.
  Form blended_form(const Polar<double>& p, double chi) const {
    Form form = weighted_form(p, sparse_, chi);
    if constexpr (C::kIsotropic) form.Hee = form.Hee + (1 - chi) * sparse_;
    else form.Hee = form.Hee + (1 - chi) * as_orthotropic(isotropic_);
    return form;
  }

  using RotatingLaw<CorotationalLaw, C>::C_;
  TangentStiffness<C> sparse_;
  IsotropicStiffness isotropic_;  // nearest to C; unused for isotropic C
};

}  // namespace orthodyn
