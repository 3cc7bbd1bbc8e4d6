#include "lib/element/neo_hookean.h"

#include <cmath>

#include "lib/core/errors.h"
#include "lib/element/axial.h"
#include "lib/element/lanes.h"
#include "lib/element/polar.h"

namespace orthodyn {

namespace {

// F = I + H in material axes, with the digits of small H kept: a few ulp of H, not of F.
struct Kinematics3 {
  Mat3T<Batch> H, cofactor;  // cof F = J F^-T
  Batch theta, log_J;        // J - 1, ln J
  Batch trace;               // of H
  Batch second_order;        // J - 1 - tr H
  Mat3T<Batch> cofactor_of_H;
};

Mat3T<Batch> cofactor_of(const Mat3T<Batch>& A) {
  Mat3T<Batch> C;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) {
      const int r = (i + 1) % 3, s = (i + 2) % 3, p = (j + 1) % 3, q = (j + 2) % 3;
      C(i, j) = A(r, p) * A(s, q) - A(r, q) * A(s, p);
    }
  return C;
}

Batch log1p(const Batch& x) {
  return per_lane([&](int l) {
    if (!(x[l] > -1) || !std::isfinite(x[l]))
      throw RecoverableError("an element is inverted or flat, where a neo-Hookean energy is infinite");
    return std::log1p(x[l]);
  });
}

Kinematics3 kinematics(const Mat3T<Batch>& H_in_axes, const Mat3T<Batch>& Q) {
  Kinematics3 k;
  k.H = Q.transpose() * H_in_axes;
  k.cofactor_of_H = cofactor_of(k.H);
  k.trace = k.H.trace();
  const Batch det_H =
      k.H(0, 0) * k.cofactor_of_H(0, 0) + k.H(0, 1) * k.cofactor_of_H(0, 1) + k.H(0, 2) * k.cofactor_of_H(0, 2);
  k.second_order = k.cofactor_of_H.trace() + det_H;  // J = 1 + tr H + tr cof H + det H
  k.theta = k.trace + k.second_order;
  k.log_J = log1p(k.theta);
  k.cofactor = (Batch(1) + k.trace) * Mat3T<Batch>::Identity() - k.H.transpose() + k.cofactor_of_H;
  return k;
}

// mu (F - F^-T) + lambda ln J F^-T, with F J - cof F = H + H^T + (J - 1 - tr H) I + (J - 1) H - cof H.
Mat3T<Batch> stress(const IsotropicStiffness& c, const Kinematics3& k) {
  const Mat3T<Batch> difference =
      k.H + k.H.transpose() + k.second_order * Mat3T<Batch>::Identity() + k.theta * k.H - k.cofactor_of_H;
  const Batch J_inverse = Batch(1) / (Batch(1) + k.theta);
  return J_inverse * (Batch(c.mu) * difference + Batch(c.lambda) * k.log_J * k.cofactor);
}

// tr(F^T F) - 3 = 2 tr H + H : H, so that the terms linear in H cancel in the energy: with x = J - 1,
// tr H - ln J = (x - ln(1 + x)) - (J - 1 - tr H).
Batch energy(const IsotropicStiffness& c, const Kinematics3& k) {
  const Batch x = k.theta;
  Batch excess = x - k.log_J;  // x^2/2 - x^3/3 + ... for small x
  const Batch series = x * x * (Batch(1.0 / 2) - x * (Batch(1.0 / 3) - x * (Batch(1.0 / 4) - x * Batch(1.0 / 5))));
  excess = select(x * x < Batch(1e-8), series, excess);
  return Batch(c.mu) * (Batch(0.5) * contract<Batch>(k.H, k.H) + excess - k.second_order) +
         Batch(0.5 * c.lambda) * k.log_J * k.log_J;
}

}  // namespace

Mat3T<Batch> neo_hookean_stress(const IsotropicStiffness& c, const Mat3T<Batch>& H, const Mat3T<Batch>& Q) {
  return Q * stress(c, kinematics(H, Q));
}

Mat3T<Batch> neo_hookean_turned_stress(const IsotropicStiffness& c, const Mat3T<Batch>& H, const Mat3T<Batch>& Q) {
  const Mat3T<Batch> P = neo_hookean_stress(c, H, Q), F = Q + H;
  Polar<Batch> p;
  const Batch::Mask good = polar(F, p);
  Mat3T<Batch> turned = p.R.transpose() * P;
  for_each_lane_outside(
      good, [&](int l) { set_lane(turned, l, polar(lane_of(F, l), lane_of(Q, l)).R.transpose() * lane_of(P, l)); });
  return turned;
}

Batch neo_hookean_energy(const IsotropicStiffness& c, const Mat3T<Batch>& H, const Mat3T<Batch>& Q) {
  return energy(c, kinematics(H, Q));
}

// dP = mu dF + (mu - lambda ln J) F^-T dF^T F^-T + lambda (F^-T : dF) F^-T.
void add_neo_hookean_moduli(const IsotropicStiffness& c, const Mat3T<Batch>& H, const Mat3T<Batch>& Q,
                            bool gauss_newton, Mat9T<Batch>& K) {
  const Kinematics3 k = kinematics(H, Q);
  const Mat3T<Batch> B = (Batch(1) / (Batch(1) + k.theta)) * k.cofactor;  // F^-T
  const Batch turning = gauss_newton ? Batch(0) : Batch(c.mu) - Batch(c.lambda) * k.log_J;
  Mat9T<Batch> own;
  for (int j = 0; j < 3; ++j)
    for (int i = 0; i < 3; ++i)
      for (int n = 0; n < 3; ++n)
        for (int m = 0; m < 3; ++m) {
          const Batch same(i == m && j == n ? c.mu : 0.0);
          own(i + 3 * j, m + 3 * n) = same + Batch(c.lambda) * B(i, j) * B(m, n) + turning * B(i, n) * B(m, j);
        }
  turn_to_space<Batch>(Q, own);
  K += own;
}

Mat3T<Batch> neo_hookean_viscous_stress(const IsotropicStiffness& c, double beta, const Mat3T<Batch>& H,
                                        const Mat3T<Batch>& Q, const Mat3T<Batch>& rate) {
  const Mat3T<Batch> F = Q.transpose() * (Q + H), F_rate = Q.transpose() * rate;  // in material axes
  const Mat3T<Batch> E_rate = symmetric_part<Batch>(F.transpose() * F_rate);
  return Q *
         (F * (Batch(2 * beta * c.mu) * E_rate + Batch(beta * c.lambda) * E_rate.trace() * Mat3T<Batch>::Identity()));
}

// dP = F (mu (F^T dF' + dF'^T F) + lambda (F : dF') I) beta, with the change dF' of the rate.
void add_neo_hookean_viscosity(const IsotropicStiffness& c, double beta, const Mat3T<Batch>& H, const Mat3T<Batch>& Q,
                               Mat9T<Batch>& D) {
  const Mat3T<Batch> F = Q.transpose() * (Q + H), FFt = F * F.transpose();
  const Batch mu(beta * c.mu), lambda(beta * c.lambda);
  Mat9T<Batch> own;
  for (int j = 0; j < 3; ++j)
    for (int i = 0; i < 3; ++i)
      for (int n = 0; n < 3; ++n)
        for (int m = 0; m < 3; ++m) {
          Batch entry = mu * F(i, n) * F(m, j) + lambda * F(i, j) * F(m, n);
          if (j == n) entry += mu * FFt(i, m);
          own(i + 3 * j, m + 3 * n) = entry;
        }
  turn_to_space<Batch>(Q, own);
  D += own;
}

Mat3T<Batch> mean_neo_hookean_stress(const IsotropicStiffness& c, const Mat3T<Batch>& H0, const Mat3T<Batch>& H1,
                                     const Mat3T<Batch>& Q) {
  const Kinematics3 k0 = kinematics(H0, Q), k1 = kinematics(H1, Q);
  const Mat3T<Batch> I = Mat3T<Batch>::Identity();
  const auto green = [](const Mat3T<Batch>& A) { return Mat3T<Batch>(A + A.transpose() + A.transpose() * A); };
  const Mat3T<Batch> E0 = green(k0.H), E1 = green(k1.H);  // F^T F - I
  const Mat3T<Batch> E = Batch(0.5) * (E0 + E1), change = E1 - E0;
  // S = 2 dPsi/dC = mu (I - C^-1) + lambda ln J C^-1 at C = I + E, and
  // det C I - cof C = E + (det C - 1 - tr E) I - cof E.
  const Mat3T<Batch> cofactor_of_E = cofactor_of_symmetric<Batch>(E);
  const Batch det_E = E(0, 0) * cofactor_of_E(0, 0) + E(0, 1) * cofactor_of_E(0, 1) + E(0, 2) * cofactor_of_E(0, 2);
  const Batch second_order = cofactor_of_E.trace() + det_E, x = E.trace() + second_order;  // det C - 1
  const Batch log_J = Batch(0.5) * log1p(x), inverse = Batch(1) / (Batch(1) + x);
  const Mat3T<Batch> cofactor = (Batch(1) + E.trace()) * I - E + cofactor_of_E;
  const Mat3T<Batch> difference = E + second_order * I - cofactor_of_E;
  const Mat3T<Batch> S = inverse * (Batch(c.mu) * difference + Batch(c.lambda) * log_J * cofactor);
  const Batch square = contract<Batch>(change, change);
  const Batch missing = energy(c, k1) - energy(c, k0) - Batch(0.5) * contract<Batch>(S, change);
  // For smaller changes, S alone does the work of the energy to round-off.
  constexpr double kSmallest = 1e-10;
  const Batch factor =
      select(square > Batch(kSmallest), Batch(2) * missing / (square + Batch(kSmallest * kSmallest)), Batch(0));
  return Q * ((I + Batch(0.5) * (k0.H + k1.H)) * (S + factor * change));
}

}  // namespace orthodyn
