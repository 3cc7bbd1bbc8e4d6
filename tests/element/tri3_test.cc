// The integration points of the triangle: exact to degree five, and no further.
#include "lib/element/tri3.h"

#include <gtest/gtest.h>

#include <cmath>

namespace orthodyn::tri3_test {
namespace {

// The mean of L1^a L2^b L3^c over a triangle is 2 a! b! c!/(a + b + c + 2)!.
double exact(int a, int b, int c) {
  return 2 * std::tgamma(a + 1) * std::tgamma(b + 1) * std::tgamma(c + 1) / std::tgamma(a + b + c + 3);
}

double by_points(int a, int b, int c) {
  double sum = 0;
  for (const auto& [N, weight] : Tri3::points())
    sum += weight * std::pow(N[0], a) * std::pow(N[1], b) * std::pow(N[2], c);
  return sum;
}

TEST(Tri3, IntegratesPolynomialsOfDegreeFiveExactly) {
  for (int a = 0; a <= 5; ++a)
    for (int b = 0; a + b <= 5; ++b)
      for (int c = 0; a + b + c <= 5; ++c)
        EXPECT_NEAR(by_points(a, b, c), exact(a, b, c), 1e-14 * exact(a, b, c)) << a << b << c;
  EXPECT_GT(std::abs(by_points(6, 0, 0) - exact(6, 0, 0)), 1e-4 * exact(6, 0, 0));
}

TEST(Tri3, NodeMeansAreThoseOfTheShapeFunctionsTimesTheField) {
  Tri3::Nodes X;
  X << 0, 2, 0, 0, 0, 3, 1, 1, 1;  // x = 2 N1, y = 3 N2
  const Vec3 means = Tri3::node_means(X, [](const Vec3& x) { return x[0] * x[1]; });
  EXPECT_LE((means - 6 * Vec3(exact(1, 1, 1), exact(0, 2, 1), exact(0, 1, 2))).norm(), 1e-15);
}

}  // namespace
}  // namespace orthodyn::tri3_test
