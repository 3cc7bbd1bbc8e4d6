// The limit at which C stops being positive definite, and the repair of unstable sets.
#include <gtest/gtest.h>

#include "lib/core/symmetric_eigen.h"
#include "lib/material/orthotropy.h"
#include "tests/material/constants.h"

namespace orthodyn::stability_test {
namespace {

// The factor t at which Rho(t r) becomes singular. Rho(t r) has the eigenvalues 1 - t (1 - lambda), where lambda are
// those of Rho(r), so t = 1 / (1 - lambda_min).
double boundary(const Vec3& r) { return 1 / (1 - symmetric_eigenvalues(rho_matrix(r))[0]); }

TEST(Stability, EndsWhereTheSmallestEigenvalueOfRhoVanishes) {
  Random random(3);
  for (int sample = 0; sample < 500; ++sample) {
    const Vec3 r = random.vector();
    const double t = boundary(r);
    EXPECT_TRUE(is_stable(with_scaled_ratios(Vec3::Ones(), t * (1 - 2 * kSmallestRhoEigenvalue) * r)));
    EXPECT_FALSE(is_stable(with_scaled_ratios(Vec3::Ones(), t * (1 + 16 * kEps) * r)));
  }
}

TEST(Stability, OfEqualNegativeRatiosEndsAtMinusOne) {
  Random random(21);
  for (int sample = 0; sample < 50; ++sample) {
    const Vec3 young(random.between(1, 100), random.between(1, 10), 1);
    EXPECT_TRUE(is_stable(stable_family(young, -1 + 2 * kSmallestRhoEigenvalue)));
    EXPECT_FALSE(is_stable(stable_family(young, -1 + 0.5 * kSmallestRhoEigenvalue)));
  }
}

TEST(Stability, IsThatOfTheWholeStiffnessMatrix) {
  Random random(4);
  for (int sample = 0; sample < 500; ++sample) {
    const auto c = with_scaled_ratios({random.between(0.1, 10), random.between(0.1, 10), 1}, random.vector());
    const Mat6 C = voigt(stiffness(c));
    EXPECT_EQ(is_stable(c), symmetric_eigenvalues(C)[0] > 0);
  }
}

TEST(Stability, NeedsPositiveModuli) {
  for (const double bad : {0.0, -1.0}) {
    for (int i = 0; i < 3; ++i) {
      auto c = spruce();
      c.young[i] = bad;
      EXPECT_FALSE(is_stable(c));
    }
    for (double OrthotropicConstants::*g :
         {&OrthotropicConstants::g12, &OrthotropicConstants::g23, &OrthotropicConstants::g13}) {
      auto c = spruce();
      c.*g = bad;
      EXPECT_FALSE(is_stable(c));
    }
  }
}

TEST(Shrink, LeavesTheSmallestEigenvalueAtTheMargin) {
  Random random(5);
  for (int sample = 0; sample < 500; ++sample) {
    const double margin = random.between(0.01, 0.5);
    const auto c = with_scaled_ratios({10.8, 0.84, 0.46}, 2 * random.vector());
    const double s = stabilising_factor(c, margin);
    const double lambda = symmetric_eigenvalues(rho_matrix(scaled_ratios(shrink_ratios(c, s))))[0];
    if (s < 1) EXPECT_NEAR(lambda, margin, 1e-14);
    else EXPECT_GE(lambda, margin - 1e-14);
  }
}

TEST(Shrink, OfEqualNegativeRatiosIsExactToo) {
  const auto c = stable_family({100, 10, 1}, -1.3);
  const double s = stabilising_factor(c, 0.05);  // reached where 1 + s nu = margin
  EXPECT_NEAR(-1.3 * s, -0.95, 1e-14);
}

TEST(Shrink, LeavesStableSetsAlone) { EXPECT_EQ(stabilising_factor(spruce()), 1); }

TEST(Shrink, KeepsModuliAndTheRatiosOfTheRatios) {
  const auto c = spruce();
  const auto half = shrink_ratios(c, 0.5);
  EXPECT_EQ(half.young, c.young);
  EXPECT_EQ(half.g13, c.g13);
  EXPECT_EQ(half.nu12, 0.5 * c.nu12);
  EXPECT_EQ(half.nu23, 0.5 * c.nu23);
  EXPECT_EQ(half.nu13, 0.5 * c.nu13);
}

}  // namespace
}  // namespace orthodyn::stability_test
