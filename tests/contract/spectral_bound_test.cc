// Close upper bounds of the largest eigenvalue of A x = lambda M x.
#include "integrators/spectral_bound.h"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <cmath>
#include <numbers>

#include "tests/contract/models.h"

namespace orthodyn::spectral_bound_test {
namespace {

constexpr double kClose = 1.02;  // the residual, which is added, is at most a hundredth of the eigenvalue

// n masses in a row between walls: eigenvalues 4 sin^2(k pi / (2 (n + 1))) / mass.
LinearModel row_of_masses(int n, double mass) {
  Matrix K = 2 * Matrix::Identity(n, n);
  for (int i = 1; i < n; ++i) K(i, i - 1) = K(i - 1, i) = -1;
  return LinearModel({.mass = mass * Matrix::Identity(n, n), .stiffness = K});
}

double largest_of_row(int n, double mass) {
  return 4 * std::pow(std::sin(0.5 * n * std::numbers::pi / (n + 1)), 2) / mass;
}

std::vector<double> stiffness_of(const Model& model, double factor = 1) {
  Linearization at;
  const Vector zero = Vector::Zero(model.num_dofs());
  model.linearize(0, zero, zero, TangentKind::exact, at);
  std::vector<double> values(model.pattern().row.size());
  model.combine({0, 0, factor}, at, values.data());
  return values;
}

TEST(SpectralBound, IsAboveTheLargestEigenvalueAndClose) {
  for (const int n : {1, 2, 15, 60, 100})
    for (const double mass : {1.0, 0.01}) {
      const auto model = row_of_masses(n, mass);
      const double exact = largest_of_row(n, mass);
      const double bound = SpectralBound(model).largest(stiffness_of(model).data());
      EXPECT_GE(bound, exact * (1 - 1e-12)) << n;
      EXPECT_LE(bound, exact * kClose) << n;
    }
}

TEST(SpectralBound, IsOneAgainAfterTheMatrixHasChanged) {
  const int n = 60;
  const auto model = row_of_masses(n, 1);
  SpectralBound bound(model);
  bound.largest(stiffness_of(model).data());
  // The sign reverses the spectrum: the warm start is almost orthogonal to the new largest mode.
  auto turned = stiffness_of(model, -1);
  std::size_t k = 0;
  for (int j = 0; j < n; ++j) {
    turned[k] += 4;  // 4 I - K, whose largest eigenvalue belongs to the slowest mode
    k += static_cast<std::size_t>(n - j);
  }
  const double exact = 4 - 4 * std::pow(std::sin(0.5 * std::numbers::pi / (n + 1)), 2);
  const double again = bound.largest(turned.data());
  EXPECT_GE(again, exact * (1 - 1e-12));
  EXPECT_LE(again, exact * kClose);
}

// An isolated largest eigenvalue converges to round-off after fewer steps than are taken.
TEST(SpectralBound, OfOneStiffSpringIsThatOfTheSpring) {
  constexpr int kMasses = 100;
  for (const double mass : {1.0, 1e-9, 1e-30}) {
    Matrix K = mass * Matrix::Identity(kMasses, kMasses);
    for (int i = 1; i < kMasses; ++i) K(i, i - 1) = K(i - 1, i) = -0.3 * mass;
    K(40, 40) = 1e8 * mass;
    const LinearModel model({.mass = mass * Matrix::Identity(kMasses, kMasses), .stiffness = K});
    const double exact = Eigen::SelfAdjointEigenSolver<Matrix>(K / mass).eigenvalues()[kMasses - 1];
    SpectralBound bound(model);
    for (int call = 0; call < 3; ++call) {
      const double found = bound.largest(stiffness_of(model).data());
      EXPECT_GE(found, exact * (1 - 1e-12)) << mass << " " << call;
      EXPECT_LE(found, exact * kClose) << mass << " " << call;
    }
  }
}

TEST(SpectralBound, OfAMatrixWithoutPositiveEigenvaluesIsZero) {
  const auto model = row_of_masses(15, 1);
  EXPECT_EQ(SpectralBound(model).largest(stiffness_of(model, 0).data()), 0);
  EXPECT_LE(SpectralBound(model).largest(stiffness_of(model, -1).data()), 1e-12);
}

// A = S + W with W skew: only the symmetric part S counts.
TEST(SpectralBound, IsThatOfTheSymmetricPart) {
  const CirculatoryModel model;
  const Pattern& pattern = model.pattern();
  ASSERT_FALSE(pattern.symmetric);
  ASSERT_EQ(model.num_dofs(), 2);
  const std::vector<double> values{5, 3, -1, 5};  // by columns: [5, -1; 3, 5], symmetric part [5, 1; 1, 5]
  Vector unit = Vector::Ones(2), mass(2);
  model.multiply_mass(unit, mass);
  ASSERT_DOUBLE_EQ(mass[0], mass[1]);
  EXPECT_NEAR(SpectralBound(model).largest(values.data()), 6 / mass[0], 1e-9);
}

}  // namespace
}  // namespace orthodyn::spectral_bound_test
