// The bulk modulus of every stiffness, the stiffness without it, and the contrast of stiffnesses.
#include <gtest/gtest.h>

#include <Eigen/Cholesky>

#include "lib/material/stiffness_contrast.h"
#include "tests/material/constants.h"

namespace orthodyn::bulk_modulus_test {
namespace {

Vec6 unit_volume() { return (Vec6() << 1, 1, 1, 0, 0, 0).finished(); }

OrthotropicStiffness spruce_stiffness() { return stiffness(spruce()); }

AnisotropicStiffness random_stiffness(unsigned seed) {
  Random random(seed);
  Mat6 root;
  for (int i = 0; i < 36; ++i) root(i) = random.between(-1, 1);
  return {Mat6(root * root.transpose() + Mat6::Identity())};
}

TEST(BulkModulus, OfAnIsotropicMaterialIsThatOfTheTextbook) {
  for (const double nu : {-0.3, 0.0, 0.3, 0.4999})
    EXPECT_NEAR(bulk_modulus(isotropic_stiffness(7, nu)) * 3 * (1 - 2 * nu) / 7, 1, 1e-11) << nu;
}

TEST(BulkModulus, IsThePressureOverTheChangeOfVolume) {
  for (const Stiffness& c : {Stiffness(spruce_stiffness()), Stiffness(random_stiffness(801))}) {
    const Vec6 strain = voigt(c).ldlt().solve(Vec6(-unit_volume()));  // under unit pressure
    EXPECT_NEAR(bulk_modulus(c) * -strain.head<3>().sum(), 1, 1e-12);
  }
}

template <class C>
void expect_no_stress_under_pressure(const C& c) {
  const double kappa = bulk_modulus(Stiffness(c));
  const Mat6 rest = voigt(without_bulk(c, kappa));
  EXPECT_LE((voigt(c) - rest - kappa * unit_volume() * unit_volume().transpose()).norm(), 1e-14 * voigt(c).norm());
  const Vec6 strain = voigt(c).ldlt().solve(unit_volume());
  EXPECT_LE((rest * strain).norm(), 1e-12);
  Eigen::SelfAdjointEigenSolver<Mat6> pairs(rest);
  EXPECT_GE(pairs.eigenvalues()[0], -1e-13 * voigt(c).norm());
  EXPECT_GT(pairs.eigenvalues()[1], 1e-6 * voigt(c).norm());
}

TEST(WithoutBulk, IsWithoutStressUnderPressureAndElsePositive) {
  expect_no_stress_under_pressure(isotropic_stiffness(7, 0.49));
  expect_no_stress_under_pressure(spruce_stiffness());
  expect_no_stress_under_pressure(random_stiffness(802));
}

TEST(VolumetricModulus, IsLamesConstantOrLeavesAPositiveStiffness) {
  const IsotropicStiffness c = isotropic_stiffness(7, 0.4);
  EXPECT_NEAR(volumetric_modulus(c), c.lambda, 1e-12 * c.lambda);
  EXPECT_NEAR(volumetric_modulus(isotropic_stiffness(7, 0)), 0, 1e-12);
  for (const Stiffness& other : {Stiffness(spruce_stiffness()), Stiffness(random_stiffness(803))}) {
    const double k = volumetric_modulus(other);
    EXPECT_GT(k, 0);
    const Mat6 rest = std::visit([&](const auto& C) { return Mat6(voigt(without_bulk(C, k))); }, other);
    EXPECT_EQ(Eigen::LLT<Mat6>(rest).info(), Eigen::Success);
  }
}

TEST(ExcessBulkModulus, IsTheBulkModulusBeyondFourShearModuli) {
  const IsotropicStiffness c = isotropic_stiffness(7, 0.4999);
  EXPECT_NEAR(excess_bulk_modulus(c) / (bulk_modulus(c) - 4 * c.mu), 1, 1e-9);
  EXPECT_LE(excess_bulk_modulus(isotropic_stiffness(7, 5.0 / 13)), 1e-12);
  EXPECT_EQ(excess_bulk_modulus(isotropic_stiffness(7, 0.3)), 0);
}

TEST(StiffnessContrast, OfAnIsotropicMaterialIsOfVolumeToShear) {
  for (const double nu : {0.1, 0.3, 0.4999}) {
    const StiffnessContrast found = stiffness_contrast(voigt(isotropic_stiffness(7, nu)));
    EXPECT_NEAR(found.ratio * (1 - 2 * nu) / (1 + nu), 1, 1e-11) << nu;
    EXPECT_TRUE(found.volumetric) << nu;
  }
}

// At the limit nu = 0.47 the ratio is 1.47 / 0.06 = 24.5; at 0.471 it is 25.4.
TEST(StiffnessContrast, IsThatOfANearlyIncompressibleMaterialFromAPoissonsRatioOn) {
  EXPECT_FALSE(is_nearly_incompressible(isotropic_stiffness(7, 0.470)));
  EXPECT_TRUE(is_nearly_incompressible(isotropic_stiffness(7, 0.471)));
  EXPECT_FALSE(is_nearly_incompressible(spruce_stiffness()));  // far stiffer along the grain
}

TEST(StiffnessContrast, WithoutBulkIsOfTheShearsOfAnIsotropicMaterial) {
  EXPECT_NEAR(contrast_without_bulk(isotropic_stiffness(7, 0.4999)), 1, 1e-9);
}

}  // namespace
}  // namespace orthodyn::bulk_modulus_test
