// Stiffness-proportional damping, whose stress is beta C dS with dS the rate of the stretch S.
#include <gtest/gtest.h>

#include <vector>

#include "lib/element/corotational_law.h"
#include "tests/element/states.h"

namespace orthodyn::viscous_test {
namespace {

const Mat3 kQ = Random(51).rotation();
constexpr double kBeta = 0.3;

const std::vector<Vec3> kRegular{{1.6, 1, 0.6}, {1.2, 0.7, 0}, {1.2, 0.7, -0.1}};
const std::vector<Vec3> kBlended{
    {1.2, 0.8, -0.6}, {1.1, 0.8, -0.7}, {1.1, 0.8, -0.8 + 1e-6}, {1.1, 0.8, -0.8}, {0, 0, 0}};

std::vector<Vec3> all_stretches() {
  std::vector<Vec3> all = kRegular;
  all.insert(all.end(), kBlended.begin(), kBlended.end());
  return all;
}

template <class C>
Mat3 viscous(const C& stiffness, const Mat3& F, const Mat3& rate) {
  const CorotationalLaw<C> law(stiffness);
  return law.template stress<double>(F - kQ, kQ, &rate, kBeta) - law.template stress<double>(F - kQ, kQ);
}

template <class C>
Mat9 damping(const C& stiffness, const Mat3& F) {
  TangentForm form;
  CorotationalLaw<C>(stiffness).tangent(F - kQ, kQ, TangentKind::exact, kBeta, &form);
  return in_space(form);
}

TEST(ViscousStress, VanishesWhenAStretchedStateTurnsRigidly) {
  Random random(52);
  for (const Vec3& s : kRegular) {
    const Mat3 F = random_state(random, s).F(), rate = cross_matrix<double>(random.vector()) * F;
    const double scale = kBeta * voigt(fibre(100)).norm() / (s[1] + s[2]);
    EXPECT_LE(viscous(fibre(100), F, rate).norm(), 64 * kEps * scale);
  }
}

// The power P : dF/dt must be beta dS : C : dS, with dS by a complex step through the polar decomposition.
TEST(ViscousStress, DissipatesTheStiffnessOfTheRateOfStretch) {
  Random random(53);
  const auto C = fibre(100);
  for (const Vec3& s : kRegular) {
    const Mat3 F = random_state(random, s).F(), rate = random.matrix();
    const Mat3 dS = derivative([](const CMat3& G) { return polar(G, Mat3::Identity()).S; }, F, rate);
    const double expected = kBeta * contract<double>(C.stress<double>(dS), dS);
    EXPECT_NEAR(contract<double>(viscous(C, F, rate), rate), expected,
                1e-13 * voigt(C).norm() / std::pow(s[1] + s[2], 2));
  }
}

TEST(ViscousStress, NeverAddsEnergy) {
  Random random(54);
  for (const Vec3& s : all_stretches())
    for (int sample = 0; sample < 20; ++sample) {
      const Mat3 F = random_state(random, s).F(), rate = random.matrix();
      const Mat3 P = viscous(fibre(100), F, rate);
      EXPECT_GE(contract<double>(P, rate), -64 * kEps * voigt(fibre(100)).norm()) << s.transpose();
      EXPECT_GE(contract<double>(viscous(kIsotropic, F, rate), rate), -64 * kEps) << s.transpose();
    }
}

TEST(ViscousStress, ExertsNoTorque) {
  Random random(55);
  for (const Vec3& s : kRegular) {
    const Mat3 F = random_state(random, s).F();
    EXPECT_LE(torque_fraction(viscous(fibre(100), F, random.matrix()), F), 1e-12);
  }
}

TEST(ViscousStress, StaysBoundedWhereRIsNotUnique) {
  Random random(56);
  for (double rho = 0.3; rho > 1e-14; rho *= 0.5) {
    const Mat3 F = random_state(random, {1.1, 0.8, -0.8 + rho}).F(), rate = random.matrix();
    // The blend factor chi ~ 10 q^3 vanishes faster than the product of two dS/dF ~ 1 / rho grows.
    EXPECT_LE(viscous(fibre(100), F, rate).norm(), 100 * kBeta * voigt(fibre(100)).norm()) << rho;
    EXPECT_LE(viscous(kIsotropic, F, rate).norm(), 100 * kBeta) << rho;
  }
}

TEST(DampingTangent, IsTheDerivativeOfTheStressByTheRate) {
  Random random(57);
  for (const Vec3& s : all_stretches()) {
    const Mat3 F = random_state(random, s).F();
    const Mat9 D = damping(fibre(100), F), isotropic = damping(kIsotropic, F);
    for (int k = 0; k < 9; ++k) {  // the stress is linear in the rate
      const double tolerance = 256 * kEps * voigt(fibre(100)).norm() / std::max(s[1] + s[2], 0.1);
      EXPECT_LE((D.col(k) - viscous(fibre(100), F, unit_matrix(k)).reshaped()).norm(), tolerance) << s.transpose();
      EXPECT_LE((isotropic.col(k) - viscous(kIsotropic, F, unit_matrix(k)).reshaped()).norm(), tolerance);
    }
  }
}

TEST(DampingTangent, IsSymmetricPositiveSemidefinite) {
  Random random(58);
  for (const Vec3& s : all_stretches()) {
    const Mat9 D = damping(fibre(100), random_state(random, s).F());
    if (D.isZero()) continue;
    EXPECT_GE(smallest_eigenvalue(D), -16 * kEps) << s.transpose();
    EXPECT_LE(asymmetry(D), 1e-13);
  }
}

TEST(DampingTangent, IsBetaTimesTheGaussNewtonTangentInRegularStates) {
  Random random(59);
  const Mat3 F = random_state(random, kRegular[0]).F();
  const Mat9 K = in_space(CorotationalLaw(fibre(100)).tangent(F - kQ, kQ, TangentKind::gauss_newton, 0, nullptr));
  EXPECT_LE((damping(fibre(100), F) - kBeta * K).norm(), 16 * kEps * K.norm());
}

}  // namespace
}  // namespace orthodyn::viscous_test
