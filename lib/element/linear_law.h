// The law of small strain: Psi = e:C:e / 2, e = sym(H), H = F - I. Its tangent is constant; it is not invariant under
// rotation.
#pragma once

#include "lib/element/corotational_law.h"

namespace orthodyn {

template <class C>
class LinearLaw {
 public:
  static constexpr const char* kName = "small strain";
  static constexpr bool kHasEnergy = true;
  using Form = TangentFormOf<TangentStiffness<C>>;

  explicit LinearLaw(const C& stiffness) : C_(stiffness) {}

  // Arguments as in corotational_law.h. Q: one rotation for all lanes (Mat3), or one per lane (Mat3T<Batch>).
  template <class T, class Axes>
  T energy(const Mat3T<T>& H, const Axes& Q) const {
    const Mat3T<T> e = small_strain<T>(H, Q);
    return T(0.5) * contract<T>(C_.stress(e), e);
  }

  template <class T, class Axes>
  Mat3T<T> stress(const Mat3T<T>& H, const Axes& Q, const Mat3T<T>* F_rate = nullptr, double beta = 0) const {
    Mat3T<T> s = C_.stress(small_strain<T>(H, Q));
    if (F_rate) s += T(beta) * C_.stress(small_strain<T>(*F_rate, Q));
    return Q.template cast<T>() * s;
  }

  // Conserves energy, P : (H1 - H0) = Psi(H1) - Psi(H0), as Psi is quadratic.
  Mat3 mean_stress(const Mat3& H0, const Mat3& H1, const Mat3& Q) const { return stress<double>(0.5 * (H0 + H1), Q); }
  template <class Axes>
  Mat3T<Batch> batch_mean_stress(const Mat3T<Batch>& H0, const Mat3T<Batch>& H1, const Axes& Q,
                                 Batch::Mask& good) const {
    return batch_stress(Mat3T<Batch>(Batch(0.5) * (H0 + H1)), Q, nullptr, 0, good);
  }

  template <class Axes>
  Mat3T<Batch> batch_stress(const Mat3T<Batch>& H, const Axes& Q, const Mat3T<Batch>* F_rate, double beta,
                            Batch::Mask& good) const {
    good = not_nan(H);
    return stress<Batch>(H, Q, F_rate, beta);
  }

  template <class Axes>
  Mat3T<Batch> batch_strain(const Mat3T<Batch>& H, const Axes& Q, Batch::Mask& good) const {
    good = not_nan(H);
    return small_strain<Batch>(H, Q);
  }

  template <class Axes>
  Batch batch_energy(const Mat3T<Batch>& H, const Axes& Q, Batch::Mask& good) const {
    good = not_nan(H);
    return energy<Batch>(H, Q);
  }

  double dissipation(const Mat3&, const Mat3& Q, const Mat3& F_rate, double beta) const {
    const Mat3 rate = small_strain<double>(F_rate, Q);
    return beta * contract<double>(C_.stress(rate), rate);
  }
  template <class Axes>
  Batch batch_dissipation(const Mat3T<Batch>&, const Axes& Q, const Mat3T<Batch>& F_rate, double beta,
                          Batch::Mask& good) const {
    const Mat3T<Batch> rate = small_strain<Batch>(F_rate, Q);
    good = not_nan(rate);
    return Batch(beta) * contract<Batch>(C_.stress(rate), rate);
  }

  static constexpr bool kHasVolumeCurvature = false;
  template <class T, class Axes>
  VolumeStrain<T> volume_strain(const Mat3T<T>& H, const Axes& Q) const {
    return {small_strain<T>(H, Q).trace(), Q.template cast<T>(), Q.template cast<T>()};
  }
  Mat3 mean_volume_gradient(const Mat3&, const Mat3&, const Mat3& Q) const { return Q; }

  Form tangent(const Mat3&, const Mat3& Q, TangentKind, double beta, Form* damping) const {
    const auto form = [&](double factor) -> Form {
      return {Q, factor * as_tangent(C_), Mat63::Zero(), Mat36::Zero(), Mat3::Zero()};
    };
    if (damping) *damping = form(beta);
    return form(1);
  }

  PointObservation observe(const Mat3& H, const Mat3& Q) const {
    return {stress<double>(H, Q) * Q.transpose(), Q, small_strain<double>(H, Q)};
  }
  template <class Axes>
  PointObservationOf<Batch> batch_observe(const Mat3T<Batch>& H, const Axes& Q, Batch::Mask& good) const {
    const Mat3T<Batch> all_axes = Q.template cast<Batch>();
    return {batch_stress(H, Q, nullptr, 0, good) * all_axes.transpose(), all_axes, small_strain<Batch>(H, Q)};
  }

 private:
  static Batch::Mask not_nan(const Mat3T<Batch>& A) { return A(0, 0) <= A(0, 0); }
  C C_;
};

}  // namespace orthodyn
