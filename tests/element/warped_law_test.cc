// The warped force R sigma: properties that it shares with the exact law, and properties that it lacks.
#include "lib/element/warped_law.h"

#include <gtest/gtest.h>

#include "tests/element/states.h"

namespace orthodyn::warped_law_test {
namespace {

const Mat3 kQ = Random(43).rotation();

template <class C>
WarpedLaw<C> warped(const C& stiffness, WarpedTangent tangent = WarpedTangent::unsymmetric) {
  return {stiffness, tangent};
}

TEST(WarpedLaw, OfAnIsotropicMaterialIsTheExactLaw) {
  Random random(44);
  const auto C = as_orthotropic(kIsotropic);
  for (int sample = 0; sample < 100; ++sample) {
    const Mat3 F = random_strain(random, 0.5).F();
    const Mat3 exact = CorotationalLaw(C).stress<double>(F - kQ, kQ);
    EXPECT_LE((warped(C).stress<double>(F - kQ, kQ) - exact).norm(), 1e-13 * kIsotropic.mu);
    EXPECT_LE((warped(kIsotropic).stress<double>(F - kQ, kQ) - exact).norm(), 1e-13 * kIsotropic.mu);
  }
}

TEST(WarpedLaw, HasTheEnergyOfTheExactLaw) {
  Random random(45);
  const Mat3 F = random_strain(random, 0.3).F();
  EXPECT_EQ(warped(fibre(100)).energy<double>(F - kQ, kQ), CorotationalLaw(fibre(100)).energy<double>(F - kQ, kQ));
}

// A stretch of 20 % at 40 degrees to the fibre.
Mat3 oblique_stretch() {
  const Vec3 n(std::cos(0.7), std::sin(0.7), 0);
  return Mat3::Identity() + 0.2 * n * n.transpose();
}

TEST(WarpedLaw, ExertsATorqueThatTheExactLawDoesNot) {
  const Mat3 F = oblique_stretch();
  for (const double ratio : {10.0, 100.0, 1000.0}) {
    EXPECT_GT(torque_fraction(warped(fibre(ratio)).stress<double>(F - kQ, kQ), F), 1e-3);
    EXPECT_LE(torque_fraction(CorotationalLaw(fibre(ratio)).stress<double>(F - kQ, kQ), F), 1e-13);
  }
}

TEST(WarpedLaw, IsNoGradientOfItsEnergyForAnAnisotropicMaterial) {
  const Mat3 F = oblique_stretch();
  const Mat3 P = warped(fibre(10)).stress<double>(F - kQ, kQ);
  EXPECT_GT((P - energy_gradient(warped(fibre(10)), F, kQ)).norm(), 1e-3 * P.norm());
}

TEST(WarpedLaw, DiffersFromTheExactLawByAtMostItsSkewPart) {
  Random random(46);
  const auto C = fibre(100);
  for (int sample = 0; sample < 50; ++sample) {
    const Deformation state = random_strain(random, 0.3);
    const Mat3 difference = state.R.transpose() * (CorotationalLaw(C).stress<double>(state.F() - kQ, kQ) -
                                                   warped(C).stress<double>(state.F() - kQ, kQ));
    EXPECT_LE(symmetric_part<double>(difference).norm(), 64 * kEps * voigt(C).norm());
  }
}

TEST(WarpedLaw, TheUnsymmetricTangentIsTheDerivativeOfTheStress) {
  Random random(47);
  for (const double ratio : {1.0, 10.0, 1e6}) {
    const auto law = warped(fibre(ratio));
    for (const Vec3& s : {Vec3(1.6, 1, 0.6), Vec3(1.2, 0.7, 0), Vec3(1.2, 0.7, -0.4)}) {
      const Mat3 F = random_state(random, s).F();
      const Mat9 H = in_space(law.tangent(F - kQ, kQ, TangentKind::exact, 0, nullptr));
      const Mat9 J = stress_jacobian(law, F, kQ);
      EXPECT_LE((H - J).norm(), 64 * kEps * J.norm());
    }
  }
}

TEST(WarpedLaw, TheUnsymmetricTangentDeservesItsName) {
  EXPECT_GT(asymmetry(in_space(warped(fibre(10)).tangent(oblique_stretch() - kQ, kQ, TangentKind::exact, 0, nullptr))),
            1e-3);
}

TEST(WarpedLaw, TheRotatedTangentIsTheRotatedStiffness) {
  Random random(48);
  const Deformation state = random_strain(random, 0.3);
  const auto form =
      warped(fibre(100), WarpedTangent::rotated).tangent(state.F() - kQ, kQ, TangentKind::exact, 0, nullptr);
  EXPECT_EQ(voigt(form.Hee), voigt(fibre(100)));
  EXPECT_LE((form.R - state.R).norm(), 64 * kEps);
  EXPECT_TRUE(form.Hea.isZero() && form.Hae.isZero() && form.Haa.isZero());
}

TEST(WarpedLaw, TheGaussNewtonTangentIsTheRotatedOne) {
  Random random(49);
  const Mat3 F = random_strain(random, 0.3).F();
  const Mat9 asked = in_space(warped(fibre(100)).tangent(F - kQ, kQ, TangentKind::gauss_newton, 0, nullptr));
  const Mat9 rotated =
      in_space(warped(fibre(100), WarpedTangent::rotated).tangent(F - kQ, kQ, TangentKind::exact, 0, nullptr));
  EXPECT_EQ(asked, rotated);
}

TEST(WarpedLaw, IsDampedLikeTheExactLaw) {
  Random random(50);
  const auto C = fibre(100);
  const Mat3 F = random_strain(random, 0.3).F(), rate = random.matrix();
  const auto viscous = [&](const auto& law) {
    return Mat3(law.template stress<double>(F - kQ, kQ, &rate, 0.1) - law.template stress<double>(F - kQ, kQ));
  };
  EXPECT_LE((viscous(warped(C)) - viscous(CorotationalLaw(C))).norm(), 64 * kEps * voigt(C).norm());
}

}  // namespace
}  // namespace orthodyn::warped_law_test
