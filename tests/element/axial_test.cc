// Identities of axial vectors and cross matrices, on which the corotational laws are based.
#include "lib/element/axial.h"

#include <gtest/gtest.h>

#include "tests/material/constants.h"

namespace orthodyn::axial_test {
namespace {

TEST(Axial, TheCrossMatrixMultipliesLikeTheCrossProduct) {
  Random random(1);
  const Vec3 w = random.vector(), x = random.vector();
  EXPECT_LE((cross_matrix<double>(w) * x - w.cross(x)).norm(), 4 * kEps);
}

TEST(Axial, OfACrossMatrixIsTwiceItsVector) {
  const Vec3 w(1, -2, 3);
  EXPECT_EQ(axial<double>(cross_matrix<double>(w)), Vec3(2 * w));
}

TEST(Axial, PairsWithAVectorLikeTheCrossMatrix) {
  Random random(2);
  const Mat3 A = random.matrix();
  const Vec3 c = random.vector();
  EXPECT_NEAR(axial<double>(A).dot(c), contract<double>(A, cross_matrix<double>(c)), 16 * kEps);
}

TEST(Axial, OfARotatedStretchIsGTimesTheRotationVector) {
  Random random(3);
  const Mat3 A = random.matrix(), S = A + A.transpose(), G = S.trace() * Mat3::Identity() - S;
  const Vec3 w = random.vector();
  EXPECT_LE((axial<double>(cross_matrix<double>(w) * S) - G * w).norm(), 32 * kEps);
}

TEST(Axial, TheCofactorIsTheDeterminantTimesTheInverse) {
  Random random(4);
  const Mat3 A = random.matrix(), S = A + A.transpose() + 3 * Mat3::Identity();
  const Mat3 expected = S.determinant() * S.inverse();
  EXPECT_LE((cofactor_of_symmetric<double>(S) - expected).norm(), 64 * kEps * S.squaredNorm());
}

}  // namespace
}  // namespace orthodyn::axial_test
