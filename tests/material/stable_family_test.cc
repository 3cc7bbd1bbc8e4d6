// The one-parameter family nu_ij = nu sqrt(E_i/E_j) of Li & Barbic (2014).
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "lib/core/symmetric_eigen.h"
#include "lib/material/material.h"
#include "tests/material/constants.h"

namespace orthodyn::stable_family_test {
namespace {

OrthotropicStiffness read_family(const Vec3& E, double nu) {
  const auto material = Registry<Material>::read(Config::from_text(
      fmt::format("{{type: orthotropic_stable, density: 1, young: [{}, {}, {}], nu: {}}}", E[0], E[1], E[2], nu)));
  return std::get<OrthotropicStiffness>(material->stiffness());
}

TEST(StableFamily, HasOneRatioForAllPairs) {
  const Vec3 r = scaled_ratios(stable_family({1e6, 30, 0.1}, 0.37));
  EXPECT_LE((r - Vec3::Constant(0.37)).cwiseAbs().maxCoeff(), 4 * kEps);
}

// C is congruent to an isotropic one: sigma = 2 mu M e M + lambda (M : e) M with M = diag(sqrt(E)).
TEST(StableFamily, IsACongruenceOfTheIsotropicLaw) {
  Random random(6);
  for (int sample = 0; sample < 300; ++sample) {
    const double nu = random.between(-0.9, 0.45);
    const Vec3 E(std::pow(10, random.between(0, 6)), std::pow(10, random.between(0, 3)), 1);
    const double mu = 1 / (2 * (1 + nu)), lambda = nu / ((1 + nu) * (1 - 2 * nu));
    const Mat3 A = random.matrix();
    const Mat3 e = A + A.transpose();
    const Mat3 M = E.cwiseSqrt().asDiagonal();
    const Mat3 expected = 2 * mu * M * e * M + lambda * (M * e).trace() * M;
    const double size = M.norm() * M.norm() * e.norm() * (2 * mu + std::abs(lambda));
    EXPECT_LE((read_family(E, nu).stress<double>(e) - expected).norm(), 1e-14 * size);
  }
}

TEST(StableFamily, WithEqualModuliIsIsotropic) {
  const double E = 7, nu = 0.3;
  const IsotropicStiffness iso{E * nu / ((1 + nu) * (1 - 2 * nu)), E / (2 * (1 + nu))};
  const Mat6 difference = voigt(read_family({E, E, E}, nu)) - voigt(as_orthotropic(iso));
  EXPECT_LE(difference.cwiseAbs().maxCoeff(), 16 * kEps * E);
}

TEST(StableFamily, IsStableForModuliSixDecadesApart) {
  for (const double nu : {-0.99, -0.3, 0.0, 0.3, 0.49, 0.4999}) {
    const auto c = stable_family({1e6, 1e3, 1}, nu);
    EXPECT_TRUE(is_stable(c)) << nu;
    EXPECT_EQ(Eigen::LLT<Mat6>(voigt(stiffness(c))).info(), Eigen::Success) << nu;
  }
}

double condition(const OrthotropicConstants& c) {
  const Vec6 lambda = symmetric_eigenvalues(mandel(voigt(stiffness(c))));
  return lambda[5] / lambda[0];
}

TEST(StableFamily, NearOneHalfHasTheConditionOfTheIsotropicLaw) {
  for (const double nu : {0.49, 0.499, 0.4999}) {
    const double factor = (1 + nu) / (1 - 2 * nu);  // condition number: 74.5, 749.5, 7499.5
    EXPECT_NEAR(condition(stable_family(Vec3::Ones(), nu)) / factor, 1, 16 * kEps * factor);
  }
}

TEST(StableFamily, HasAConditionBoundedByThatOfModuliTimesIsotropicLaw) {
  for (const double nu : {-0.9, -0.3, 0.0, 0.3, 0.49}) {
    const double factor = (1 + nu) / (1 - 2 * nu);
    EXPECT_LE(condition(stable_family({1000, 10, 1}, nu)), 1000 * std::max(factor, 1 / factor) * (1 + 1e-10));
  }
}

TEST(StableFamily, TheShearFactorScalesTheShearModuliOnly) {
  const auto material = Registry<Material>::read(
      Config::from_text("{type: orthotropic_stable, density: 1, young: [4, 2, 1], nu: 0.3, shear_factor: 0.25}"));
  const auto C = std::get<OrthotropicStiffness>(material->stiffness());
  const auto plain = read_family({4, 2, 1}, 0.3);
  EXPECT_EQ(C.g12, 0.25 * plain.g12);
  EXPECT_EQ(C.g31, 0.25 * plain.g31);
  EXPECT_EQ(C.c11, plain.c11);
}

}  // namespace
}  // namespace orthodyn::stable_family_test
