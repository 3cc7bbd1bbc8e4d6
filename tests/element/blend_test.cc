// The blend of an anisotropic energy into the nearest isotropic one, when an element inverts.
#include "lib/element/blend.h"

#include <gtest/gtest.h>

#include "lib/core/symmetric_eigen.h"
#include "lib/element/corotational_law.h"
#include "tests/element/states.h"

namespace orthodyn::blend_test {
namespace {

template <class T>
T det_G(const Mat3T<T>& S) {
  const Mat3T<T> G = S.trace() * Mat3T<T>::Identity() - S;
  return G.determinant();
}

template <class T>
Blend<T> blend_of(const Mat3T<T>& S) {
  return blend<T>(S, det_G<T>(S));
}

Blend<double> blend_of(const Vec3& s) { return blend_of<double>(Mat3(s.asDiagonal())); }

TEST(Blend, LeavesTheModelUntouchedInRegularStates) {
  Random random(28);
  int reached = 0;
  for (int sample = 0; sample < 2000; ++sample) {
    const Mat3 S = random_state(random, {random.between(0, 2), random.between(0, 2), random.between(0, 2)}).S();
    if (det_G<double>(S) < kBlendG0) continue;
    ++reached;
    EXPECT_EQ(blend_of(S).chi, 1);
    EXPECT_EQ(blend_of(S).gradient, Mat3(Mat3::Zero()));
  }
  EXPECT_GT(reached, 1000);
}

TEST(Blend, IsZeroWhereRIsNotUnique) {
  for (const Vec3& s : {Vec3(1, 1, -1), Vec3(1.1, 0.8, -0.8), Vec3(1, 0, 0), Vec3(0, 0, 0)}) {
    EXPECT_EQ(blend_of(s).chi, 0);
    EXPECT_EQ(blend_of(s).gradient, Mat3(Mat3::Zero()));
  }
}

TEST(Blend, LiesBetweenZeroAndOne) {
  Random random(29);
  for (int sample = 0; sample < 2000; ++sample) {
    const double b = random.between(0, 2);
    const double chi = blend_of(Vec3(b + random.between(0, 1), b, random.between(-b, b))).chi;
    EXPECT_GE(chi, 0);
    EXPECT_LE(chi, 1);
  }
}

// Principal stretches with 0 < chi < 1: two inverted elements and a thin one that is not inverted.
const Vec3 kZone[] = {{1.1, 0.8, -0.7}, {0.5, 0.4, -0.2}, {1, 0.03, 0.02}};

TEST(Blend, GradientIsTheDerivativeOfChi) {
  Random random(30);
  for (const Vec3& s : kZone) {
    const Mat3 S = random_state(random, s).S(), A = random.matrix(), dS = A + A.transpose();
    const auto b = blend_of(S);
    ASSERT_GT(b.chi, 0);
    ASSERT_LT(b.chi, 1);
    const CMat3 stepped = S.cast<Complex>() + Complex(0, kComplexStep) * dS.cast<Complex>();
    const double rate = blend_of(stepped).chi.imag() / kComplexStep;
    EXPECT_NEAR(contract<double>(b.gradient, dS), rate, 1e-13 * b.gradient.norm() * dS.norm());
  }
}

// Varies s3 of the stretches (1.1, 0.8, s3). Where q reaches 1, 1 - chi ~ (1 - q)^3 and dchi/dS ~ (1 - q)^2.
TEST(Blend, EndsWithTwoContinuousDerivatives) {
  double low = -0.7, high = -0.1;
  for (int i = 0; i < 60; ++i) {
    const double middle = 0.5 * (low + high);
    (blend_of(Vec3(1.1, 0.8, middle)).chi < 1 ? low : high) = middle;
  }
  const auto inside = [&](double h) { return blend_of(Vec3(1.1, 0.8, low - h)); };
  const double order = std::log2((1 - inside(2e-3).chi) / (1 - inside(1e-3).chi));
  const double slope_order = std::log2(inside(2e-3).gradient.norm() / inside(1e-3).gradient.norm());
  EXPECT_NEAR(order, 3, 0.1);
  EXPECT_NEAR(slope_order, 2, 0.1);
}

TEST(Blend, KeepsTheStressBoundedAroundTheSingularSet) {
  Random random(31);
  const auto C = fibre(100);
  const CorotationalLaw law(C);
  // Bound: the largest eigenvalue of C times the norm of the strain (0.1, -0.2, -1.8). Without the blend the stress
  // would grow as 29 / (s2 + s3).
  const double stiffest = symmetric_eigenvalues(mandel(voigt(C)))[5];
  const double bound = stiffest * Vec3(0.1, 0.2, 1.8).norm();
  for (double rho = 0.3; rho > 1e-14; rho *= 0.5)
    for (int sample = 0; sample < 50; ++sample) {
      const Mat3 F = random_state(random, {1.1, 0.8, -0.8 + rho}).F();
      EXPECT_LE(law.stress<double>(F - Mat3::Identity(), Mat3::Identity()).norm(), bound) << rho;
    }
}

TEST(Blend, MakesTheEnergySingleValuedOnTheSingularSet) {
  Random random(32);
  const CorotationalLaw law(fibre(100));
  const Mat3 F = random_state(random, {1.1, 0.8, -0.8}).F();
  const double energy = law.energy<double>(F - Mat3::Identity(), Mat3::Identity());
  for (int sample = 0; sample < 50; ++sample) {
    const Mat3 near = F + 1e-7 * random.matrix();
    EXPECT_NEAR(law.energy<double>(near - Mat3::Identity(), Mat3::Identity()), energy, 1e-4 * energy);
  }
}

TEST(Blend, LetsCollapsedElementsHaveFiniteEnergyAndStress) {
  const CorotationalLaw law(fibre(100));
  for (const Vec3& s : {Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(1, 1, 0), Vec3(1, 1, -1), Vec3(-1, -1, -1)}) {
    const Mat3 F = s.asDiagonal();
    EXPECT_TRUE(std::isfinite(law.energy<double>(F - Mat3::Identity(), Mat3::Identity()))) << s.transpose();
    EXPECT_TRUE(law.stress<double>(F - Mat3::Identity(), Mat3::Identity()).allFinite()) << s.transpose();
  }
}

}  // namespace
}  // namespace orthodyn::blend_test
