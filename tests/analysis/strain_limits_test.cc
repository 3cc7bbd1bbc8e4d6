// Strain limits against the acoustic tensor: at the limit, and not before, its smallest eigenvalue over all directions
// changes sign.
#include "lib/analysis/strain_limits.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

#include "lib/core/symmetric_eigen.h"
#include "lib/element/corotational_law.h"
#include "tests/element/states.h"

namespace orthodyn::strain_limits_test {
namespace {

// Deformation gradient with strain e along `axis` under uniaxial stress.
Mat3 uniaxial(const OrthotropicStiffness& C, int axis, double e) {
  const Mat3 S = voigt(C).topLeftCorner<3, 3>().inverse();
  return Mat3::Identity() + Mat3(Vec3(e / S(axis, axis) * S.col(axis)).asDiagonal());
}

double softest_wave(const Mat9& H, const Vec3& n) {
  Mat3 A = Mat3::Zero();
  for (int b = 0; b < 3; ++b)
    for (int d = 0; d < 3; ++d) A += n[b] * n[d] * H.block<3, 3>(3 * b, 3 * d);
  return symmetric_eigenvalues(A)[0];
}

// Smallest eigenvalue of the acoustic tensor over directions sampled on a half sphere, axes included.
double smallest_acoustic_eigenvalue(const OrthotropicStiffness& C, const Mat3& F) {
  const Mat9 H =
      in_space(CorotationalLaw(C).tangent(F - Mat3::Identity(), Mat3::Identity(), TangentKind::exact, 0, nullptr));
  constexpr int kSteps = 12;
  double smallest = std::numeric_limits<double>::infinity();
  for (int i = 0; i <= kSteps; ++i)
    for (int j = 0; j < 4 * kSteps; ++j) {
      const double theta = 0.5 * M_PI * i / kSteps, phi = 0.5 * M_PI * j / kSteps;
      const Vec3 n(std::cos(theta), std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi));
      smallest = std::min(smallest, softest_wave(H, n));
    }
  return smallest;
}

std::vector<OrthotropicStiffness> materials() {
  std::vector<OrthotropicStiffness> all{stiffness(spruce())};
  for (const double ratio : {10.0, 100.0, 1000.0}) all.push_back(fibre(ratio));
  OrthotropicConstants rolling = spruce();  // nu21 < 0, soft in the plane 2-3
  rolling.nu12 = -0.2;
  rolling.g23 = 0.01;
  all.push_back(stiffness(rolling));
  return all;
}

// The path from rest ends where the section is flat; no other limit may come before.
bool is_elliptic_until(const OrthotropicStiffness& C, int axis, double end) {
  for (const double part : {0.3, 0.7, 0.9, 0.99, 0.9999})
    if (smallest_acoustic_eigenvalue(C, uniaxial(C, axis, part * end)) < 0) return false;
  return true;
}

TEST(StrainLimits, AreWhereTheAcousticTensorStopsBeingPositive) {
  int lost = 0;
  for (const auto& C : materials())
    for (int axis = 0; axis < 3; ++axis) {
      const AxisLimits limits = strain_limits(C)[static_cast<std::size_t>(axis)];
      for (const auto& limit : {limits.compression, limits.tension}) {
        if (!limit) continue;
        EXPECT_TRUE(is_elliptic_until(C, axis, limit->strain)) << axis << " " << limit->strain;
        if (limit->kind == LimitKind::flat) continue;
        ++lost;
        EXPECT_LT(smallest_acoustic_eigenvalue(C, uniaxial(C, axis, 1.0001 * limit->strain)), 0)
            << axis << " " << limit->strain;
      }
    }
  EXPECT_GE(lost, 12);
}

TEST(StrainLimits, AreAbsentWhereTheLawStaysElliptic) {
  for (const double nu : {-0.3, 0.3, 0.49}) {
    const IsotropicStiffness C = isotropic_stiffness(1, nu);
    for (int axis = 0; axis < 3; ++axis) {
      EXPECT_FALSE(strain_limits(C)[static_cast<std::size_t>(axis)].compression) << nu;
      EXPECT_TRUE(is_elliptic_until(as_orthotropic(C), axis, -0.95)) << nu;
    }
  }
}

// Stable family, nu = 0.3: two digits by the formulas.
TEST(StrainLimits, OfAFibreGrowNarrowWithItsStiffness) {
  const auto along_fibre = [](double ratio) { return strain_limits(fibre(ratio))[0]; };
  EXPECT_NEAR(along_fibre(10).compression->strain, -0.223, 0.001);
  EXPECT_NEAR(along_fibre(100).compression->strain, -0.0664, 0.0001);
  EXPECT_NEAR(along_fibre(1000).compression->strain, -0.0206, 0.0001);
  for (const double ratio : {10.0, 100.0, 1000.0}) {
    const double mu = std::sqrt(ratio) / 2.6;
    EXPECT_NEAR(along_fibre(ratio).tension->strain, 4 * mu / (ratio - 4 * mu), 1e-12);
    EXPECT_EQ(along_fibre(ratio).tension->kind, LimitKind::slide);
  }
}

// nu12 = 0.3 sqrt(r); with a large shear modulus no other limit comes first.
TEST(StrainLimits, IncludeTheStrainThatLeavesASectionWithoutThickness) {
  auto c = stable_family({100, 1, 1}, 0.3);
  c.g12 = c.g13 = 1000;
  const AxisLimits limits = strain_limits(stiffness(c))[0];
  ASSERT_TRUE(limits.tension);
  EXPECT_EQ(limits.tension->kind, LimitKind::flat);
  EXPECT_NEAR(limits.tension->strain, 1 / 3.0, 1e-12);
  EXPECT_EQ(describe(*limits.tension, 0).substr(0, 14), "is flat along ");
}

// The same fibre as 21 constants, rotated about its axis; the limits are found numerically.
TEST(StrainLimits, OfAFullCAreThoseOfTheOrthotropicOneThatItDescribes) {
  const auto nine = strain_limits(fibre(100));
  for (const double angle : {0.0, 0.4}) {
    const auto full = strain_limits(turned(fibre(100), Eigen::AngleAxisd(angle, Vec3::UnitX()).toRotationMatrix()));
    ASSERT_TRUE(full[0].compression && full[0].tension);
    EXPECT_NEAR(full[0].compression->strain, nine[0].compression->strain, 1e-3 * 0.0664);
    EXPECT_NEAR(full[0].tension->strain, nine[0].tension->strain, 1e-3 * 0.182);
    EXPECT_FALSE(full[1].compression || full[2].compression);
  }
  const Mat3 exchange = Eigen::AngleAxisd(M_PI / 2, Vec3::UnitZ()).toRotationMatrix();  // the fibre along 2
  EXPECT_NEAR(strain_limits(turned(fibre(100), exchange))[1].compression->strain, -0.0664, 2e-4);
}

TEST(StrainLimits, DoNotDependOnTheUnitOfStress) {
  const auto in_pascal = strain_limits(1e9 * stiffness(spruce())), in_giga = strain_limits(stiffness(spruce()));
  for (std::size_t i = 0; i < 3; ++i)
    EXPECT_NEAR(in_pascal[i].compression->strain, in_giga[i].compression->strain, 1e-13);
}

}  // namespace
}  // namespace orthodyn::strain_limits_test
