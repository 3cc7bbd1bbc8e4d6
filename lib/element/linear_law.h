// Small strain: Psi = e:C:e / 2 with e = sym(F) - I. Not invariant under rotation; its tangent is
// constant.
#pragma once

#include "lib/element/corotational_law.h"

namespace orthodyn {

template <class C>
class LinearLaw {
 public:
  static constexpr const char* kName = "small strain";
  static constexpr bool kBatchesNeedAxes = true;
  static constexpr bool kHasEnergy = true;
  using Form = TangentFormOf<TangentStiffness<C>>;

  explicit LinearLaw(const C& stiffness) : C_(stiffness) {}

  // Q: one rotation for all lanes of a batch (Mat3), or one for each (Mat3T<Batch>).
  template <class T, class Axes>
  T energy(const Mat3T<T>& F, const Axes& Q) const {
    const Mat3T<T> e = strain<T>(F, Q);
    return T(0.5) * contract<T>(C_.stress(e), e);
  }

  template <class T, class Axes>
  Mat3T<T> stress(const Mat3T<T>& F, const Axes& Q, const Mat3T<T>* F_rate = nullptr,
                  double beta = 0) const {
    Mat3T<T> s = C_.stress(strain<T>(F, Q));
    if (F_rate) s += T(beta) * C_.stress(Mat3T<T>(symmetric_part<T>(Q.transpose().template cast<T>() * *F_rate)));
    return Q.template cast<T>() * s;
  }

  // With P : (F1 - F0) = Psi(F1) - Psi(F0): Psi is quadratic.
  Mat3 mean_stress(const Mat3& F0, const Mat3& F1, const Mat3& Q) const {
    return stress<double>(0.5 * (F0 + F1), Q);
  }

  template <class Axes>
  Mat3T<Batch> batch_stress(const Mat3T<Batch>& F, const Axes& Q, const Mat3T<Batch>* F_rate, double beta,
                            Batch::Mask& good) const {
    good = F(0, 0) <= F(0, 0);  // all but NaN
    return stress<Batch>(F, Q, F_rate, beta);
  }

  template <class Axes>
  Batch batch_energy(const Mat3T<Batch>& F, const Axes& Q, Batch::Mask& good) const {
    good = F(0, 0) <= F(0, 0);  // all but NaN
    return energy<Batch>(F, Q);
  }

  double dissipation(const Mat3&, const Mat3& Q, const Mat3& F_rate, double beta) const {
    const Mat3 rate = symmetric_part<double>(Q.transpose() * F_rate);
    return beta * contract<double>(C_.stress(rate), rate);
  }
  template <class Axes>
  Batch batch_dissipation(const Mat3T<Batch>&, const Axes& Q, const Mat3T<Batch>& F_rate, double beta,
                          Batch::Mask& good) const {
    const Mat3T<Batch> rate = symmetric_part<Batch>(Q.transpose().template cast<Batch>() * F_rate);
    good = rate(0, 0) <= rate(0, 0);  // all but NaN
    return Batch(beta) * contract<Batch>(C_.stress(rate), rate);
  }

  Form tangent(const Mat3&, const Mat3& Q, TangentKind, double beta, Form* damping) const {
    const auto form = [&](double factor) -> Form {
      return {Q, factor * as_tangent(C_), Mat63::Zero(), Mat36::Zero(), Mat3::Zero()};
    };
    if (damping) *damping = form(beta);
    return form(1);
  }

  PointObservation observe(const Mat3& F, const Mat3& Q) const {
    return {stress<double>(F, Q) * Q.transpose(), Q, strain<double>(F, Q)};
  }

 private:
  // In material axes; F is F Q.
  template <class T, class Axes>
  static Mat3T<T> strain(const Mat3T<T>& F, const Axes& Q) {
    return symmetric_part<T>(Q.transpose().template cast<T>() * F) - Mat3T<T>::Identity();
  }

  C C_;
};

}  // namespace orthodyn
