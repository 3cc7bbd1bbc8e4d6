// The wedges of 15 and 18 nodes, and the rules of the triangle that they use.
#include <gtest/gtest.h>

#include <cmath>

#include "lib/element/wedge15.h"
#include "lib/element/wedge18.h"
#include "tests/element/isoparametric_tests.h"

namespace orthodyn::wedge_test {
namespace {

using namespace isoparametric_tests;

struct Wedge15Case {
  using Element = Wedge15;
  static constexpr int kZeroModes = 6;
  static constexpr bool kQuadraticIfBilinear = false;
  static bool interpolates(int i, int j, int) { return i + j <= 1; }
};

struct Wedge18Case {
  using Element = Wedge18;
  static constexpr int kZeroModes = 6;
  static constexpr bool kQuadraticIfBilinear = true;
  static bool interpolates(int i, int j, int) { return i + j <= 2; }
};

INSTANTIATE_TYPED_TEST_SUITE_P(Wedge15, IsoparametricElement, Wedge15Case);
INSTANTIATE_TYPED_TEST_SUITE_P(Wedge18, IsoparametricElement, Wedge18Case);

// The mean of L1^a L2^b L3^c over a triangle is 2 a! b! c!/(a + b + c + 2)!.
double exact(int a, int b, int c) {
  return 2 * std::tgamma(a + 1) * std::tgamma(b + 1) * std::tgamma(c + 1) / std::tgamma(a + b + c + 3);
}

double by_points(const std::vector<TrianglePoint>& points, int a, int b, int c) {
  double sum = 0;
  for (const auto& [L, weight] : points) sum += weight * std::pow(L[0], a) * std::pow(L[1], b) * std::pow(L[2], c);
  return sum;
}

TEST(TrianglePoints, OfDegreesTwoAndFourIntegratePolynomialsExactlyUpToTheirDegree) {
  for (const int degree : {2, 4}) {
    const auto& points = degree == 2 ? triangle_points_of_degree_2() : triangle_points_of_degree_4();
    for (int a = 0; a <= degree; ++a)
      for (int b = 0; a + b <= degree; ++b)
        for (int c = 0; a + b + c <= degree; ++c)
          EXPECT_NEAR(by_points(points, a, b, c), exact(a, b, c), 1e-14 * exact(a, b, c)) << a << b << c;
    EXPECT_GT(std::abs(by_points(points, degree + 1, 0, 0) - exact(degree + 1, 0, 0)), 1e-3 * exact(degree + 1, 0, 0));
  }
}

TEST(Wedge15, PointsAreThoseOfTheTriangleInThreeLayers) {
  for (int p = 0; p < 9; ++p) {
    const Vec3 at = Wedge15::place(p);
    EXPECT_NEAR(at[0], p % 3 == 1 ? 2.0 / 3 : 1.0 / 6, 1e-15) << p;
    EXPECT_NEAR(at[1], p % 3 == 2 ? 2.0 / 3 : 1.0 / 6, 1e-15) << p;
    EXPECT_NEAR(at[2], std::sqrt(0.6) * (p / 3 - 1), 1e-15) << p;
  }
}

// Zienkiewicz & Taylor's formulas at one place, written out.
TEST(Wedge15, ShapeFunctionsAreThoseOfTheSource) {
  const double r = 0.2, s = 0.3, L = 0.5, t = 0.4;
  const auto N = Wedge15::shape({r, s, t});
  EXPECT_NEAR(N[0], L * (2 * L - 1) * (1 - t) / 2 - L * (1 - t * t) / 2, 1e-15);
  EXPECT_NEAR(N[4], r * (2 * r - 1) * (1 + t) / 2 - r * (1 - t * t) / 2, 1e-15);
  EXPECT_NEAR(N[7], 2 * r * s * (1 - t), 1e-15);
  EXPECT_NEAR(N[11], 2 * s * L * (1 + t), 1e-15);
  EXPECT_NEAR(N[14], s * (1 - t * t), 1e-15);
}

}  // namespace
}  // namespace orthodyn::wedge_test
