#include "lib/element/hex20.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "tests/element/isoparametric_tests.h"

namespace orthodyn::hex20_test {
namespace {

using namespace isoparametric_tests;

struct Hex20Case {
  using Element = Hex20;
  static constexpr int kZeroModes = 12;
  static constexpr bool kQuadraticIfBilinear = false;
  static bool interpolates(int i, int j, int k) { return i <= 1 && j <= 1 && k <= 1; }
};

INSTANTIATE_TYPED_TEST_SUITE_P(Hex20, IsoparametricElement, Hex20Case);

const std::vector<QuadraturePoint>& reduced() { return Hex20::points(); }

// The stiffness of n1 x n2 equal cubes. `clamped`: without the freedoms of the end x = -1.
Eigen::MatrixXd stiffness_of_cubes(int n1, int n2, bool clamped,
                                   const std::vector<QuadraturePoint>& points = reduced()) {
  std::vector<Vec3> nodes;
  const auto node_at = [&](const Vec3& x) {
    const auto same = std::find_if(nodes.begin(), nodes.end(), [&](const Vec3& y) { return (x - y).norm() < 1e-12; });
    const auto index = same - nodes.begin();
    if (same == nodes.end()) nodes.push_back(x);
    return static_cast<int>(index);
  };
  std::vector<std::array<int, 20>> cells;
  for (int i = 0; i < n1; ++i)
    for (int j = 0; j < n2; ++j) {
      std::array<int, 20>& cell = cells.emplace_back();
      for (int a = 0; a < 20; ++a)
        cell[static_cast<std::size_t>(a)] = node_at(Hex20::nodes().col(a) + Vec3(2 * i, 2 * j, 0));
    }
  const auto size = static_cast<Eigen::Index>(3 * nodes.size());
  Eigen::MatrixXd K = Eigen::MatrixXd::Zero(size, size);
  const Eigen::MatrixXd own = isotropic_stiffness<Hex20>(Hex20::nodes(), points);
  for (const auto& cell : cells)
    for (int a = 0; a < 20; ++a)
      for (int b = 0; b < 20; ++b)
        K.block<3, 3>(3 * cell[static_cast<std::size_t>(a)], 3 * cell[static_cast<std::size_t>(b)]) +=
            own.block<3, 3>(3 * a, 3 * b);
  std::vector<Eigen::Index> kept;
  for (Eigen::Index k = 0; k < size; ++k)
    if (!clamped || nodes[static_cast<std::size_t>(k / 3)][0] > -0.5) kept.push_back(k);
  return K(kept, kept);
}

TEST(Hex20, ARowOfSingleCubesHasAZeroEnergyModePerFreeCrossSection) {
  for (const int cells : {2, 3, 5}) EXPECT_EQ(zero_modes(stiffness_of_cubes(cells, 1, false)), 6 + cells + 1) << cells;
  for (const int cells : {1, 2, 3}) EXPECT_EQ(zero_modes(stiffness_of_cubes(cells, 1, true)), cells) << cells;
}

TEST(Hex20, FourCubesAroundAnEdgeHaveRigidMotionsOnly) { EXPECT_EQ(zero_modes(stiffness_of_cubes(2, 2, false)), 6); }

TEST(Hex20, WithFourteenPointsHasRigidMotionsOnlyAsZeroEnergyModes) {
  Random random(430);
  EXPECT_EQ(zero_modes(isotropic_stiffness<Hex20>(random_curved<Hex20>(random), irons_points())), 6);
  for (const int cells : {1, 2, 3, 5}) {
    EXPECT_EQ(zero_modes(stiffness_of_cubes(cells, 1, false, irons_points())), 6) << cells;
    EXPECT_EQ(zero_modes(stiffness_of_cubes(cells, 1, true, irons_points())), 0) << cells;
  }
}

TEST(Hex20, ExtrapolatesFromFourteenPointsByTheirPolynomials) {
  const Eigen::MatrixXd to_nodes = Hex20::extrapolation(irons_points(), &Hex20::interpolation_14);
  for (int m = 0; m < 14; ++m) {
    Vector at_points(14), at_nodes(20);
    for (int p = 0; p < 14; ++p)
      at_points[p] = Hex20::interpolation_14(irons_points()[static_cast<std::size_t>(p)].place)[m];
    for (int a = 0; a < 20; ++a) at_nodes[a] = Hex20::interpolation_14(Hex20::nodes().col(a))[m];
    EXPECT_LE((to_nodes * at_points - at_nodes).norm(), 1e-13) << m;
  }
}

TEST(Hex20, CornersHaveNegativeIntegralsSoThatRowSumsAreNoMasses) {
  const Vector sums = Hex20::consistent_mass(Hex20::nodes(), 1).rowwise().sum();
  for (int a = 0; a < 20; ++a) EXPECT_NEAR(sums[a], a < 8 ? -1.0 : 4.0 / 3, 1e-13) << a;
}

double by_points(const std::vector<QuadraturePoint>& points, int i, int j, int k) {
  double sum = 0;
  for (const auto& [x, weight] : points) sum += weight * std::pow(x[0], i) * std::pow(x[1], j) * std::pow(x[2], k);
  return sum;
}

double exact(int i) { return i % 2 == 0 ? 2.0 / (i + 1) : 0; }

TEST(CubePoints, IntegratePolynomialsExactlyUpToTheDegreeOfTheLine) {
  const auto coarse = cube_points(line_points_of_degree_3()), fine = cube_points(line_points_of_degree_5());
  for (int i = 0; i <= 5; ++i)
    for (int j = 0; j <= 5; ++j)
      for (int k = 0; k <= 5; ++k) {
        const double expected = exact(i) * exact(j) * exact(k);
        EXPECT_NEAR(by_points(fine, i, j, k), expected, 1e-14) << i << j << k;
        if (std::max({i, j, k}) <= 3) {
          EXPECT_NEAR(by_points(coarse, i, j, k), expected, 1e-14) << i << j << k;
        }
      }
  EXPECT_GT(std::abs(by_points(coarse, 0, 4, 0) - 4 * exact(4)), 0.1);
  EXPECT_GT(std::abs(by_points(fine, 0, 0, 6) - 4 * exact(6)), 0.1);
}

TEST(CubePoints, OfIronsIntegrateDegreeFiveExactly) {
  const auto points = irons_points();
  for (int i = 0; i <= 5; ++i)
    for (int j = 0; i + j <= 5; ++j)
      for (int k = 0; i + j + k <= 5; ++k)
        EXPECT_NEAR(by_points(points, i, j, k), exact(i) * exact(j) * exact(k), 1e-14) << i << j << k;
  EXPECT_GT(std::abs(by_points(points, 6, 0, 0) - 4 * exact(6)), 0.01);
}

}  // namespace
}  // namespace orthodyn::hex20_test
