// Quadrilateral faces of 8 and 9 nodes, their quadrature rule, and the points of triangular faces.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "lib/element/quad8.h"
#include "lib/element/quad9.h"
#include "lib/element/tri3.h"
#include "lib/element/tri6.h"
#include "tests/material/constants.h"

namespace orthodyn::quad_test {
namespace {

// The mean of x^i over [-1, 1].
double mean(int i) { return i % 2 == 0 ? 1.0 / (i + 1) : 0; }

double by_points(int i, int j) {
  double sum = 0;
  for (const auto& [place, weight] : square_points_of_degree_5())
    sum += weight * std::pow(place[0], i) * std::pow(place[1], j);
  return sum;
}

TEST(SquarePoints, IntegratePolynomialsOfDegreeFiveInEachCoordinateExactly) {
  for (int i = 0; i <= 5; ++i)
    for (int j = 0; j <= 5; ++j) EXPECT_NEAR(by_points(i, j), 4 * mean(i) * mean(j), 1e-14) << i << j;
  EXPECT_GT(std::abs(by_points(6, 0) - 4 * mean(6)), 0.05);
}

TEST(LinePoints, IntegratePolynomialsExactlyUpToTheirDegree) {
  for (const int degree : {3, 5}) {
    const auto& points = degree == 3 ? line_points_of_degree_3() : line_points_of_degree_5();
    const auto error = [&](int i) {
      double sum = 0;
      for (const auto& [x, weight] : points) sum += weight * std::pow(x, i);
      return std::abs(sum - 2 * mean(i));
    };
    for (int i = 0; i <= degree; ++i) EXPECT_LE(error(i), 1e-15) << i;
    EXPECT_GT(error(degree + 1), 0.02);
  }
}

TEST(TriangularFaces, HaveThePointsOfDegreeFiveWithHalfTheirShares) {
  const auto& rule = triangle_points_of_degree_5();
  for (std::size_t p = 0; p < rule.size(); ++p) {
    EXPECT_EQ(Tri6::points()[p].place, rule[p].L);
    EXPECT_EQ(Tri6::points()[p].weight, 0.5 * rule[p].weight);
    EXPECT_EQ(Tri3::points()[p].weight, 0.5 * rule[p].weight);
  }
}

template <class F>
class Quadrilateral : public testing::Test {};
using Quadrilaterals = testing::Types<Quad8, Quad9>;
TYPED_TEST_SUITE(Quadrilateral, Quadrilaterals, );

using Scalar = Eigen::Matrix<double, 1, 1>;

// Corners counterclockwise as seen from +z, then the middles of the edges 01, 12, 23, 30, the centre.
template <class F>
FaceNodes<F> square() {
  Eigen::Matrix<double, 3, 9> all;
  all << -1, 1, 1, -1, 0, 1, 0, -1, 0,  //
      -1, -1, 1, 1, -1, 0, 1, 0, 0,     //
      0, 0, 0, 0, 0, 0, 0, 0, 0;
  return all.leftCols<F::kNodes>();
}

TYPED_TEST(Quadrilateral, ShapeFunctionsAreOneAtTheirNodeAndZeroAtTheOthers) {
  using F = TypeParam;
  for (Eigen::Index a = 0; a < F::kNodes; ++a)
    EXPECT_LE((F::shape(square<F>().col(a)) - Eigen::Matrix<double, F::kNodes, 1>::Unit(a)).norm(), kEps) << a;
}

TYPED_TEST(Quadrilateral, ShapeFunctionsReproduceQuadratics) {
  using F = TypeParam;
  const FaceNodes<F> X = square<F>();
  const Vec3 at(0.3, -0.7, 0);
  const auto value = [](const Vec3& x) { return 1 + x[0] - 2 * x[1] + x[0] * x[0] - 3 * x[0] * x[1] + x[1] * x[1]; };
  double sum = 0;
  for (Eigen::Index a = 0; a < F::kNodes; ++a) sum += F::shape(at)[a] * value(X.col(a));
  EXPECT_NEAR(sum, value(at), 1e-14);
}

TYPED_TEST(Quadrilateral, SlopesAreThoseOfTheShapeFunctions) {
  using F = TypeParam;
  const Vec3 at(0.3, -0.7, 0);
  const Eigen::Vector2d along(0.6, 0.8);
  const auto error = [&](double h) {
    const Vec3 step = h * Vec3(along[0], along[1], 0);
    return ((F::shape(at + step) - F::shape(at - step)) / (2 * h) - F::slopes(at) * along).norm();
  };
  EXPECT_NEAR(std::log2(error(0.02) / error(0.01)), 2, 0.01);
}

TYPED_TEST(Quadrilateral, NormalOfAParallelogramIsAQuarterOfItsAreaVector) {
  using F = TypeParam;
  const Vec3 a(2, 1, 0), b(0, 3, 1);  // half of its edges
  FaceNodes<F> X;
  for (Eigen::Index k = 0; k < F::kNodes; ++k) X.col(k) = a * square<F>()(0, k) + b * square<F>()(1, k);
  EXPECT_LE((normal_at<F>(X, {0.3, -0.7, 0}) - a.cross(b)).norm(), 1e-14);
  EXPECT_NEAR(area<F>(X), 4 * a.cross(b).norm(), 1e-13);
}

// On a rectangle of 4 x 6 with the field x^2 y^3, where N_a g has degree 5 in x and y or less.
TYPED_TEST(Quadrilateral, NodeIntegralsAreThoseOfTheShapeFunctionsTimesTheField) {
  using F = TypeParam;
  FaceNodes<F> X = square<F>();
  X.row(0) *= 2;
  X.row(1) *= 3;
  const auto integrals = node_integrals<F>(X, [](const Vec3& x) { return Scalar(x[0] * x[0] * std::pow(x[1], 3)); });
  // Nodal values of x^i y^j in [-1, 1]^2, of which the element contains those with i + j <= 2.
  for (int i = 0; i <= 2; ++i)
    for (int j = 0; i + j <= 2; ++j) {
      double sum = 0;
      for (Eigen::Index a = 0; a < F::kNodes; ++a)
        sum += integrals(a) * std::pow(square<F>()(0, a), i) * std::pow(square<F>()(1, a), j);
      EXPECT_NEAR(sum, 24 * 4 * 27 * mean(2 + i) * mean(3 + j), 1e-12) << i << j;
    }
}

TEST(Quad9, PointSharesAreTheIntegralsOfTheShapeFunctions) {
  const auto integrals = node_integrals<Quad9>(square<Quad9>(), [](const Vec3&) { return Scalar(0.25); });
  for (int a = 0; a < 9; ++a) EXPECT_NEAR(Quad9::kPointShares[static_cast<std::size_t>(a)], integrals(a), 1e-14);
}

// Faces with nodes on the sixth of the unit sphere that a cube's face is projected to. The error of the area is of
// fourth order in their size.
TYPED_TEST(Quadrilateral, AreaOfASphereConverges) {
  using F = TypeParam;
  const auto error = [](int parts) {
    double sum = 0;
    for (int i = 0; i < parts; ++i)
      for (int j = 0; j < parts; ++j) {
        const Vec3 centre((2.0 * i + 1) / parts - 1, (2.0 * j + 1) / parts - 1, 1);
        FaceNodes<F> X = (square<F>() / parts).colwise() + centre;
        for (auto node : X.colwise()) node.normalize();
        sum += area<F>(X);
      }
    return std::abs(sum - 2 * std::numbers::pi / 3);
  };
  EXPECT_NEAR(std::log2(error(4) / error(8)), 4, 0.4);
}

}  // namespace
}  // namespace orthodyn::quad_test
