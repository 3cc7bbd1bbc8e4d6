// The neo-Hookean law: closed forms, derivatives, small strains, mean stresses.
#include "lib/element/neo_hookean.h"

#include <gtest/gtest.h>

#include "lib/core/errors.h"
#include "lib/element/axial.h"
#include "tests/element/batch_checks.h"
#include "tests/element/states.h"

namespace orthodyn::neo_hookean_test {
namespace {

constexpr IsotropicStiffness kRubber{1.3, 0.4};  // lambda, mu

double energy(const Mat3& F, const Mat3& Q) { return neo_hookean_energy(kRubber, everywhere(F - Q), everywhere(Q))[0]; }
Mat3 stress(const Mat3& F, const Mat3& Q) {
  return first_lane(neo_hookean_stress(kRubber, everywhere(F - Q), everywhere(Q)));
}
Mat9 moduli(const Mat3& F, const Mat3& Q, bool gauss_newton) {
  Mat9T<Batch> K = Mat9T<Batch>::Zero();
  add_neo_hookean_moduli(kRubber, everywhere(F - Q), everywhere(Q), gauss_newton, K);
  return first_lane(K);
}
Mat3 mean_stress(const Mat3& F0, const Mat3& F1, const Mat3& Q) {
  return first_lane(mean_neo_hookean_stress(kRubber, everywhere(F0 - Q), everywhere(F1 - Q), everywhere(Q)));
}

const Vec3 kStretches[] = {{1.3, 1, 0.8}, {3, 0.6, 0.3}, {1.001, 1, 0.999}};

TEST(NeoHookean, EnergyAndStressAreThoseOfTheFormulae) {
  Random random(401);
  for (const Vec3& s : kStretches) {
    const Mat3 F = random_state(random, s).F(), Q = random.rotation();
    const double log_J = std::log(s.prod()), I1 = s.squaredNorm();
    const double W = kRubber.mu / 2 * (I1 - 3) - kRubber.mu * log_J + kRubber.lambda / 2 * log_J * log_J;
    EXPECT_NEAR(energy(F * Q, Q), W, 1e-13 * std::abs(W) + 1e-15);
    const Mat3 inverse = F.inverse().transpose();
    const Mat3 P = kRubber.mu * (F - inverse) + kRubber.lambda * log_J * inverse;
    EXPECT_LE((stress(F * Q, Q) - P * Q).norm(), 1e-12 * P.norm() + 1e-13);
  }
}

TEST(NeoHookean, StressIsTheGradientOfTheEnergyAndModuliThatOfTheStress) {
  Random random(402);
  for (const Vec3& s : {kStretches[0], kStretches[1]}) {
    const Mat3 F = random_state(random, s).F(), Q = random.rotation(), d = random.matrix(), P = stress(F, Q);
    expect_order_two([&](double h) {
      const Mat3 step = h * d;
      return std::abs((energy(F + step, Q) - energy(F - step, Q)) / (2 * h) - contract<double>(P, d)) / P.norm();
    });
    const Mat9 K = moduli(F, Q, false);
    EXPECT_LE((K - K.transpose()).norm(), 1e-13 * K.norm());
    const Vector expected = K * Vector(d.reshaped());
    expect_order_two([&](double h) {
      const Mat3 step = h * d, change = (stress(F + step, Q) - stress(F - step, Q)) / (2 * h);
      return (Vector(change.reshaped()) - expected).norm() / K.norm();
    });
    EXPECT_GE(smallest_eigenvalue(moduli(F, Q, true)), -1e-14);
  }
}

// A few ulp of the strain, not of F.
TEST(NeoHookean, SmallStrainsKeepTheirDigits) {
  Random random(403);
  const Mat3 Q = random.rotation(), unit = random.matrix(), strain = 0.5 * (unit + unit.transpose());
  for (const double size : {1e-6, 1e-9, 1e-12}) {
    const Mat3 H = size * unit;
    const Mat3 P = first_lane(neo_hookean_stress(kRubber, everywhere(H * Q), everywhere(Q))) * Q.transpose();
    const Mat3 hooke = 2 * kRubber.mu * strain + kRubber.lambda * strain.trace() * Mat3::Identity();
    EXPECT_LE((P / size - hooke).norm(), (30 * size + 1e-14) * hooke.norm()) << size;
    const double W = neo_hookean_energy(kRubber, everywhere(H * Q), everywhere(Q))[0];
    EXPECT_NEAR(W / (size * size), 0.5 * contract<double>(hooke, strain), (30 * size + 1e-14) * hooke.norm()) << size;
  }
}

TEST(NeoHookean, ExertsNoTorqueAndTurnsWithTheBody) {
  Random random(404);
  for (const Vec3& s : kStretches) {
    const Mat3 F = random_state(random, s).F(), Q = random.rotation(), turn = random.rotation(), P = stress(F, Q);
    EXPECT_LE(torque_fraction(P, F), 1e-12);
    EXPECT_LE((stress(turn * F, Q) - turn * P).norm(), 1e-12 * (P.norm() + 1));
  }
}

TEST(NeoHookean, MeanStressDoesTheWorkThatTheEnergyLoses) {
  Random random(405);
  const Mat3 Q = random.rotation(), F0 = random_state(random, kStretches[0]).F();
  const Mat3 F1 = random_state(random, kStretches[1]).F(), P = mean_stress(F0, F1, Q);
  EXPECT_NEAR(contract<double>(P, Mat3(F1 - F0)), energy(F1, Q) - energy(F0, Q), 1e-13 * P.norm() * (F1 - F0).norm());
  EXPECT_LE(torque_fraction(P, Mat3(F0 + F1)), 1e-13);
  const Mat3 d = random.matrix();
  for (const double h : {1e-3, 1e-5, 1e-8}) {
    const Mat3 near = F0 + h * d, middle = stress(F0 + 0.5 * h * d, Q);
    EXPECT_LE((mean_stress(F0, near, Q) - middle).norm(), (100 * h * h + 1e-9) * middle.norm()) << h;
  }
}

TEST(NeoHookean, ViscousStressIsLinearInTheRateAndVanishesForRigidMotions) {
  Random random(406);
  const double beta = 0.3;
  const Mat3 Q = random.rotation(), F = random_state(random, kStretches[1]).F(), rate = random.matrix();
  const auto viscous = [&](const Mat3& F_rate) {
    return Mat3(
        first_lane(neo_hookean_viscous_stress(kRubber, beta, everywhere(F - Q), everywhere(Q), everywhere(F_rate))));
  };
  Mat9T<Batch> all = Mat9T<Batch>::Zero();
  add_neo_hookean_viscosity(kRubber, beta, everywhere(F - Q), everywhere(Q), all);
  const Mat9 D = first_lane(all);
  EXPECT_LE((D * Vector(rate.reshaped()) - Vector(viscous(rate).reshaped())).norm(), 1e-13 * viscous(rate).norm());
  EXPECT_GE(smallest_eigenvalue(D), -1e-14);
  const Mat3 spin = cross_matrix<double>(random.vector());
  EXPECT_LE(viscous(spin * F).norm(), 1e-13 * viscous(rate).norm());
  // At rest it is beta times Hooke's stress of the rate.
  const Mat3 e = 0.5 * (rate + rate.transpose()),
             hooke = 2 * kRubber.mu * e + kRubber.lambda * e.trace() * Mat3::Identity();
  const Mat3 at_rest = first_lane(
      neo_hookean_viscous_stress(kRubber, beta, everywhere(Mat3::Zero()), everywhere(Q), everywhere(rate * Q)));
  EXPECT_LE((at_rest * Q.transpose() - beta * hooke).norm(), 1e-14 * hooke.norm());
}

TEST(NeoHookean, InvertedStatesAreRecoverableErrors) {
  const Mat3 Q = Mat3::Identity();
  for (const Vec3& s : {Vec3(1, 1, -0.5), Vec3(1, 1, 0)}) EXPECT_THROW(stress(s.asDiagonal(), Q), RecoverableError);
}

// The stress grows without bound where the body is flattened.
TEST(NeoHookean, ResistsFlattening) {
  const Mat3 Q = Mat3::Identity();
  double last = 0;
  for (const double s : {1e-1, 1e-2, 1e-3}) {
    const double pressure = -stress(Vec3(1, 1, s).asDiagonal(), Q)(2, 2);
    EXPECT_GE(pressure, 5 * last);
    last = pressure;
  }
}

}  // namespace
}  // namespace orthodyn::neo_hookean_test
