// Faces: the quadrature rule of the triangle, and integrals over linear and quadratic triangles.
#include "lib/element/tri3.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "lib/element/tri6.h"
#include "tests/element/states.h"

namespace orthodyn::tri3_test {
namespace {

// The mean of L1^a L2^b L3^c over a triangle is 2 a! b! c!/(a + b + c + 2)!.
double exact(int a, int b, int c) {
  return 2 * std::tgamma(a + 1) * std::tgamma(b + 1) * std::tgamma(c + 1) / std::tgamma(a + b + c + 3);
}

double by_points(int a, int b, int c) {
  double sum = 0;
  for (const auto& [L, weight] : triangle_points_of_degree_5())
    sum += weight * std::pow(L[0], a) * std::pow(L[1], b) * std::pow(L[2], c);
  return sum;
}

TEST(TrianglePoints, IntegratePolynomialsOfDegreeFiveExactly) {
  for (int a = 0; a <= 5; ++a)
    for (int b = 0; a + b <= 5; ++b)
      for (int c = 0; a + b + c <= 5; ++c)
        EXPECT_NEAR(by_points(a, b, c), exact(a, b, c), 1e-14 * exact(a, b, c)) << a << b << c;
  EXPECT_GT(std::abs(by_points(6, 0, 0) - exact(6, 0, 0)), 1e-4 * exact(6, 0, 0));
}

FaceNodes<Tri6> with_middles(const FaceNodes<Tri3>& X) {
  FaceNodes<Tri6> all;
  all << X, (X.col(0) + X.col(1)) / 2, (X.col(1) + X.col(2)) / 2, (X.col(2) + X.col(0)) / 2;
  return all;
}

using Scalar = Eigen::Matrix<double, 1, 1>;

TEST(Tri3, NodeIntegralsAreThoseOfTheShapeFunctionsTimesTheField) {
  FaceNodes<Tri3> X;
  X << 0, 2, 0, 0, 0, 3, 1, 1, 1;  // x = 2 N1 and y = 3 N2 with the shape functions N; area 3
  const auto integrals = node_integrals<Tri3>(X, [](const Vec3& x) { return Scalar(x[0] * x[1]); });
  EXPECT_LE((integrals.transpose() - 18 * Vec3(exact(1, 1, 1), exact(0, 2, 1), exact(0, 1, 2))).norm(), 1e-14);
  EXPECT_NEAR(area<Tri3>(X), 3, 1e-14);
}

TEST(Tri6, SharesOfAPlaneFaceGoToTheMiddles) {
  FaceNodes<Tri3> X;
  X << 0, 2, 0, 0, 0, 3, 1, 1, 1;
  const auto integrals = node_integrals<Tri6>(with_middles(X), [](const Vec3&) { return Scalar(1); });
  for (int a = 0; a < 6; ++a) EXPECT_NEAR(integrals(a), a < 3 ? 0 : 1, 1e-14);
}

TEST(Tri6, SlopesAreThoseOfTheShapeFunctions) {
  const Vec3 L(0.2, 0.3, 0.5);
  for (int i = 0; i < 2; ++i) {
    const Vec3 along = 1e-4 * (Vec3::Unit(i + 1) - Vec3::Unit(0));
    const auto difference = ((Tri6::shape(L + along) - Tri6::shape(L - along)) / 2e-4).eval();
    EXPECT_LE((difference - Tri6::slopes(L).col(i)).norm(), 1e-11);
  }
}

// Quadratic triangles with nodes on an octant of the unit sphere. The error of the area is of fourth order in their
// size.
TEST(Tri6, AreaOfASphereConverges) {
  const auto error = [](int parts) {
    double sum = 0;
    for (int i = 0; i < parts; ++i)
      for (int j = 0; j < parts - i; ++j)
        for (const bool upper : {false, true}) {
          if (upper && i + j + 2 > parts) continue;
          FaceNodes<Tri3> X;
          if (upper) X << i + 1, i + 1, i, j, j + 1, j + 1, 0, 0, 0;
          else X << i, i + 1, i, j, j, j + 1, 0, 0, 0;
          X.row(2) = Eigen::RowVector3d::Constant(parts) - X.row(0) - X.row(1);
          FaceNodes<Tri6> curved = with_middles(X);
          for (Eigen::Index a = 0; a < 6; ++a) curved.col(a).normalize();
          sum += area<Tri6>(curved);
        }
    return std::abs(sum - std::numbers::pi / 2);
  };
  EXPECT_NEAR(std::log2(error(4) / error(8)), 4, 0.4);
}

}  // namespace
}  // namespace orthodyn::tri3_test
