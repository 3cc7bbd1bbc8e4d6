// Energy and stress of the exact corotational law.
#include "lib/element/corotational_law.h"

#include <gtest/gtest.h>

#include <vector>

#include "tests/element/states.h"

namespace orthodyn::corotational_law_test {
namespace {

const Mat3 kQ = Random(20).rotation();  // material axes; F below denotes F Q

// Principal stretches: regular, flat, inverted with chi = 1, and inverted within the zone of the blend.
const std::vector<Vec3> kStretches{{1.6, 1, 0.6},    {1.05, 1, 0.98},  {1.2, 0.7, 0},
                                   {1.2, 0.7, -0.1}, {1.2, 0.7, -0.4}, {1.1, 0.8, -0.7}};

template <class C>
void expect_stress_is_the_energy_gradient(const C& stiffness) {
  Random random(21);
  const CorotationalLaw<C> law(stiffness);
  const double size = voigt(stiffness).norm();
  for (const Vec3& s : kStretches)
    for (int sample = 0; sample < 20; ++sample) {
      const Mat3 F = random_state(random, s).F();
      const Mat3 error = law.template stress<double>(F - kQ, kQ) - energy_gradient(law, F, kQ);
      EXPECT_LE(error.norm(), 64 * kEps * size / (s[1] + s[2])) << s.transpose();
    }
}

TEST(CorotationalLaw, StressIsTheGradientOfTheEnergy) {
  expect_stress_is_the_energy_gradient(fibre(10));
  expect_stress_is_the_energy_gradient(fibre(1e6));
  expect_stress_is_the_energy_gradient(stiffness(spruce()));
}

TEST(CorotationalLaw, StressOfAnIsotropicMaterialIsTheGradientOfTheEnergy) {
  expect_stress_is_the_energy_gradient(kIsotropic);
}

TEST(CorotationalLaw, StressOfAnAnisotropicMaterialIsTheGradientOfTheEnergy) {
  expect_stress_is_the_energy_gradient(turned(fibre(10), Random(28).rotation()));
  expect_stress_is_the_energy_gradient(turned(stiffness(spruce()), Random(29).rotation()));
}

TEST(CorotationalLaw, TheStretchesOfTheseTestsReachIntoTheBlend) {
  const auto chi = [](const Vec3& s) {
    const auto p = polar(s.asDiagonal().toDenseMatrix(), Mat3::Identity());
    return blend<double>(p.S, p.det_G).chi;
  };
  EXPECT_EQ(chi(kStretches[2]), 1);
  EXPECT_GT(chi(kStretches.back()), 0);
  EXPECT_LT(chi(kStretches.back()), 1);
}

// (V^T R^T P V)_jk = sigma_jk 2 s_j / (s_j + s_k), with the eigenvectors V and eigenvalues s of S.
TEST(CorotationalLaw, StressInTheEigenframeIsSigmaTimesTheRatioOfStretches) {
  Random random(22);
  const auto C = fibre(100);
  for (int sample = 0; sample < 100; ++sample) {
    const Deformation state = random_strain(random, 0.4);
    const Mat3 sigma = state.V.transpose() * C.stress<double>(state.S() - Mat3::Identity()) * state.V;
    const Mat3 P =
        state.V.transpose() * state.R.transpose() * CorotationalLaw(C).stress<double>(state.F() - kQ, kQ) * state.V;
    for (int j = 0; j < 3; ++j)
      for (int k = 0; k < 3; ++k)
        EXPECT_NEAR(P(j, k), sigma(j, k) * 2 * state.s[j] / (state.s[j] + state.s[k]), 64 * kEps * voigt(C).norm());
  }
}

TEST(CorotationalLaw, RotationsAreFreeOfStressAlsoForModuliSixDecadesApart) {
  Random random(23);
  for (const double ratio : {1.0, 100.0, 1e6}) {
    const CorotationalLaw law(fibre(ratio));
    const double size = voigt(fibre(ratio)).cwiseAbs().maxCoeff();
    for (int sample = 0; sample < 50; ++sample) {
      const Mat3 R = random.rotation();
      EXPECT_LE(law.stress<double>(R - kQ, kQ).cwiseAbs().maxCoeff(), 16 * kEps * size);
      EXPECT_LE(law.energy<double>(R - kQ, kQ), 256 * kEps * kEps * size);
    }
  }
}

TEST(CorotationalLaw, TurnsWithTheState) {
  Random random(24);
  const CorotationalLaw law(fibre(100));
  for (const Vec3& s : kStretches) {
    const Mat3 F = random_state(random, s).F(), R0 = random.rotation();
    const Mat3 P = law.stress<double>(F - kQ, kQ);
    const double tolerance = 64 * kEps * voigt(fibre(100)).norm() / (s[1] + s[2]);
    EXPECT_LE((law.stress<double>(R0 * F - kQ, kQ) - R0 * P).norm(), tolerance);
    EXPECT_NEAR(law.energy<double>(R0 * F - kQ, kQ), law.energy<double>(F - kQ, kQ), tolerance);
  }
}

TEST(CorotationalLaw, ExertsNoTorque) {
  Random random(25);
  for (const double ratio : {10.0, 100.0, 1000.0})
    for (const Vec3& s : kStretches) {
      const Mat3 F = random_state(random, s).F();
      EXPECT_LE(torque_fraction(CorotationalLaw(fibre(ratio)).stress<double>(F - kQ, kQ), F), 1e-13) << s.transpose();
    }
}

TEST(CorotationalLaw, OfAnIsotropicMaterialIsTheTextbookLaw) {
  Random random(26);
  const CorotationalLaw law(kIsotropic);
  const CorotationalLaw general(as_orthotropic(kIsotropic));
  for (int sample = 0; sample < 100; ++sample) {
    const Deformation state = random_strain(random, 0.5);
    const Vec3 e = state.s - Vec3::Ones();
    const Vec3 sigma = 2 * kIsotropic.mu * e + Vec3::Constant(kIsotropic.lambda * e.sum());
    const Mat3 P = state.R * state.V * sigma.asDiagonal() * state.V.transpose();
    EXPECT_LE((law.stress<double>(state.F() - kQ, kQ) - P).norm(), 1e-13 * kIsotropic.mu);
    EXPECT_LE((general.stress<double>(state.F() - kQ, kQ) - P).norm(), 1e-13 * kIsotropic.mu);
    EXPECT_NEAR(law.energy<double>(state.F() - kQ, kQ), 0.5 * sigma.dot(e), 1e-13 * kIsotropic.mu);
  }
}

TEST(CorotationalLaw, ObservesTheCauchyStressOfAUniaxialStretch) {
  const auto constants = stable_family({100, 1, 1}, 0.3);
  const double e = 0.05, lateral = -constants.nu12 * e;
  const Vec3 s(1 + e, 1 + lateral, 1 + lateral);
  const Mat3 R = Random(27).rotation();
  const auto seen = CorotationalLaw(stiffness(constants)).observe(R * s.asDiagonal() - kQ, kQ);
  const Vec3 expected(constants.young[0] * e / (s[1] * s[2]), 0, 0);
  EXPECT_LE((R.transpose() * seen.cauchy * R - Mat3(expected.asDiagonal())).norm(), 64 * kEps * constants.young[0]);
  EXPECT_LE((seen.axes - R).norm(), 16 * kEps);
  EXPECT_LE((seen.strain - Mat3((s - Vec3::Ones()).asDiagonal())).norm(), 16 * kEps);
}

TEST(CorotationalLaw, ObservesNoCauchyStressInAnInvertedElement) {
  const Mat3 F = Vec3(1.2, 0.7, -0.4).asDiagonal();
  EXPECT_TRUE(CorotationalLaw(fibre(10)).observe(F - kQ, kQ).cauchy.array().isNaN().all());
}

}  // namespace
}  // namespace orthodyn::corotational_law_test
