// C computed from engineering constants, compared with the compliance of Li & Barbic (2014) eq. (4).
#include "lib/material/orthotropy.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>

#include "tests/material/constants.h"

namespace orthodyn::orthotropy_test {
namespace {

Mat6 compliance(const OrthotropicConstants& c) {
  const double E1 = c.young[0], E2 = c.young[1], E3 = c.young[2];
  Mat6 S = Mat6::Zero();
  S.topLeftCorner<3, 3>() << 1 / E1, -c.nu12 / E1, -c.nu13 / E1,  //
      -c.nu12 / E1, 1 / E2, -c.nu23 / E2,                         //
      -c.nu13 / E1, -c.nu23 / E2, 1 / E3;
  S.diagonal().tail<3>() << 1 / c.g12, 1 / c.g23, 1 / c.g13;
  return S;
}

TEST(Orthotropy, StiffnessIsTheInverseOfTheCompliance) {
  Random random(1);
  for (int sample = 0; sample < 1000; ++sample) {
    const auto c = random_stable(random);
    const double lambda = rho_eigenvalues(c)[0];
    Vec6 root = Vec6::Ones();
    root.head<3>() = c.young.cwiseSqrt();
    const Mat6 scaled = root.cwiseInverse().asDiagonal() * voigt(stiffness(c)) * compliance(c) * root.asDiagonal();
    EXPECT_LE((scaled - Mat6::Identity()).cwiseAbs().maxCoeff(), 16 * kEps / lambda);
  }
}

TEST(Orthotropy, SpruceHasItsClosedFormStiffness) {
  const auto C = stiffness(spruce());
  const double tolerance = 0.5e-6;  // the source gives six decimals
  EXPECT_NEAR(C.c11, 11.248642, tolerance);
  EXPECT_NEAR(C.c22, 0.967018, tolerance);
  EXPECT_NEAR(C.c33, 0.527857, tolerance);
  EXPECT_NEAR(C.c12, 0.555174, tolerance);
  EXPECT_NEAR(C.c31, 0.386865, tolerance);
  EXPECT_NEAR(C.c23, 0.245497, tolerance);
}

TEST(Orthotropy, ShearModuliGoToTheirPlanes) {
  const auto C = stiffness(spruce());
  EXPECT_EQ(C.g12, spruce().g12);
  EXPECT_EQ(C.g23, spruce().g23);
  EXPECT_EQ(C.g31, spruce().g13);
}

TEST(Orthotropy, SpruceHasItsEigenvaluesOfRho) {
  const Vec3 lambda = rho_eigenvalues(spruce());
  EXPECT_NEAR(lambda[0], 0.606192, 0.5e-6);
  EXPECT_NEAR(lambda[1], 1.067874, 0.5e-6);
  EXPECT_NEAR(lambda[2], 1.325935, 0.5e-6);
}

TEST(RhoEigenvalues, AreTheRootsOfTheCharacteristicPolynomialInAscendingOrder) {
  Random random(2);
  for (int sample = 0; sample < 1000; ++sample) {
    const Vec3 r = 1.5 * random.vector();
    const double p = r.squaredNorm(), q = r.prod();
    const Vec3 mu = rho_eigenvalues(with_scaled_ratios(Vec3::Ones(), r)) - Vec3::Ones();
    EXPECT_TRUE(std::is_sorted(mu.begin(), mu.end()));
    // With the eigenvalues 1 + mu of Rho: det((1 + mu) I - Rho) = mu^3 - p mu + 2 q.
    EXPECT_NEAR(mu.sum(), 0, 32 * kEps);
    for (const double m : mu) EXPECT_NEAR(m * m * m - p * m + 2 * q, 0, 64 * kEps * (1 + p * std::sqrt(p)));
  }
}

TEST(RhoEigenvalues, AreExactWhereTwoCoincide) {
  Random random(20);
  for (const double nu : {-0.999999, -0.5, -1e-9, 1e-9, 0.25, 0.499999}) {
    Vec3 expected(1 - 2 * nu, 1 + nu, 1 + nu);
    std::sort(expected.begin(), expected.end());
    for (int sample = 0; sample < 20; ++sample) {
      const Vec3 young(random.between(1, 100), random.between(1, 10), 1);
      const Vec3 lambda = rho_eigenvalues(with_scaled_ratios(young, Vec3::Constant(nu)));
      EXPECT_LE((lambda - expected).cwiseAbs().maxCoeff(), 8 * kEps) << nu;
    }
  }
}

TEST(RhoEigenvalues, AreOneWithoutCoupling) {
  EXPECT_EQ(rho_eigenvalues(with_scaled_ratios({3, 2, 1}, Vec3::Zero())), Vec3::Ones());
  EXPECT_EQ(rho_eigenvalues(with_scaled_ratios({3, 2, 1}, Vec3::Constant(1e-160))), Vec3::Ones());
}

TEST(RhoEigenvalues, DoNotDependOnTheRatioOfTheModuli) {
  const Vec3 r(0.5, -0.3, 0.7);
  const Vec3 even = rho_eigenvalues(with_scaled_ratios(Vec3::Ones(), r));
  const Vec3 uneven = rho_eigenvalues(with_scaled_ratios({1e12, 1, 1e-6}, r));
  EXPECT_LE((even - uneven).cwiseAbs().maxCoeff(), 8 * kEps);
}

// The constants with renamed material axes: the new axis i is the old axis order[i].
OrthotropicConstants permuted(const OrthotropicConstants& c, const std::array<int, 3>& order) {
  const Vec3& E = c.young;
  const double nu[3][3] = {
      {0, c.nu12, c.nu13}, {c.nu12 * E[1] / E[0], 0, c.nu23}, {c.nu13 * E[2] / E[0], c.nu23 * E[2] / E[1], 0}};
  const double g[3][3] = {{0, c.g12, c.g13}, {c.g12, 0, c.g23}, {c.g13, c.g23, 0}};
  const auto [a, b, d] = order;
  return {Vec3(E[a], E[b], E[d]), nu[a][b], nu[b][d], nu[a][d], g[a][b], g[b][d], g[a][d]};
}

TEST(Orthotropy, RenamingTheMaterialAxesRenamesTheEntriesOfTheStiffness) {
  const Mat6 C = voigt(stiffness(spruce()));
  std::array<int, 3> order{0, 1, 2};
  while (std::next_permutation(order.begin(), order.end())) {
    const Mat6 renamed = voigt(stiffness(permuted(spruce(), order)));
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) {
        const auto a = order[static_cast<std::size_t>(i)], b = order[static_cast<std::size_t>(j)];
        EXPECT_NEAR(component(renamed, i, i, j, j), component(C, a, a, b, b), 8 * kEps * C(a, a));
        EXPECT_NEAR(component(renamed, i, j, i, j), component(C, a, b, a, b), 8 * kEps * C(a, a));
      }
  }
}

}  // namespace
}  // namespace orthodyn::orthotropy_test
