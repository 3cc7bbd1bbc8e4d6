// Singular values and vectors of matrices with few columns, constructed from known ones.
#include "lib/analysis/singular_vectors.h"

#include <gtest/gtest.h>

#include <Eigen/QR>
#include <algorithm>
#include <limits>
#include <vector>

#include "tests/material/constants.h"

namespace orthodyn::singular_vectors_test {
namespace {

constexpr double kEpsilon = std::numeric_limits<double>::epsilon();

Eigen::MatrixXd orthonormal_columns(Random& random, Eigen::Index rows, Eigen::Index columns) {
  const auto entry = [&] { return random.between(-1, 1); };
  const Eigen::HouseholderQR<Eigen::MatrixXd> qr(Eigen::MatrixXd::NullaryExpr(rows, columns, entry));
  return qr.householderQ() * Eigen::MatrixXd::Identity(rows, columns);
}

std::vector<double> ascending(const Vector& values) {
  std::vector<double> out(values.begin(), values.end());
  std::sort(out.begin(), out.end());
  return out;
}

TEST(SingularVectors, AreThoseThatTheMatrixWasMadeFrom) {
  Random random(410);
  const Vector made{{1e-12, 1e-9, 1e-3, 1, 1, 40}};
  for (const Eigen::Index rows : {6, 7, 300}) {
    const Eigen::MatrixXd V = orthonormal_columns(random, 6, 6);
    const Eigen::MatrixXd A = orthonormal_columns(random, rows, 6) * made.asDiagonal() * V.transpose();
    const SingularVectors found = right_singular_vectors(A);
    const auto values = ascending(found.values);
    for (std::size_t k = 0; k < 6; ++k)
      EXPECT_NEAR(values[k], made[static_cast<Eigen::Index>(k)], 64 * kEpsilon * made.maxCoeff());
    EXPECT_LE((found.V.transpose() * found.V - Eigen::MatrixXd::Identity(6, 6)).norm(), 64 * kEpsilon);
    for (Eigen::Index k = 0; k < 6; ++k)
      EXPECT_NEAR((A * found.V.col(k)).norm(), found.values[k], 64 * kEpsilon * made.maxCoeff());
  }
}

// The singular values of {{1, s}, {0, s}}: their product is the determinant s, the larger is 1 to within s^2.
TEST(SingularVectors, OfSmallColumnsHaveTheirDigits) {
  const double s = 1e-20;
  const auto values = ascending(right_singular_vectors(Eigen::MatrixXd{{1, s}, {0, s}}).values);
  EXPECT_NEAR(values[0], s, 4 * kEpsilon * s);
  EXPECT_NEAR(values[1], 1, 4 * kEpsilon);
}

TEST(SingularVectors, AreEigenvectorsOfASymmetricMatrix) {
  Random random(412);
  const Eigen::MatrixXd Q = orthonormal_columns(random, 5, 5);
  const Vector eigenvalues{{0, 1e-3, 2, -3, 5}};
  const Eigen::MatrixXd E = Q * eigenvalues.asDiagonal() * Q.transpose();
  const Eigen::MatrixXd V = right_singular_vectors(E).V;
  const Eigen::MatrixXd turned = V.transpose() * E * V;
  EXPECT_LE((turned - Eigen::MatrixXd(turned.diagonal().asDiagonal())).norm(), 1e-12);
  const auto found = ascending(turned.diagonal()), expected = ascending(eigenvalues);
  for (std::size_t k = 0; k < 5; ++k) EXPECT_NEAR(found[k], expected[k], 1e-12);
}

TEST(SingularVectors, OfAMatrixWithFewerRowsThanColumnsIncludeItsNullSpace) {
  const Eigen::MatrixXd A{{1, 1, 0}, {0, 0, 2}};
  const SingularVectors found = right_singular_vectors(A);
  const auto values = ascending(found.values);
  EXPECT_LE(values[0], kEpsilon);
  EXPECT_NEAR(values[1], std::sqrt(2.0), 4 * kEpsilon);
  EXPECT_NEAR(values[2], 2, 4 * kEpsilon);
}

TEST(SingularVectors, OfZeroAreAnyBasis) {
  const SingularVectors found = right_singular_vectors(Eigen::MatrixXd::Zero(4, 3));
  EXPECT_EQ(found.values.norm(), 0);
  EXPECT_LE((found.V.transpose() * found.V - Eigen::MatrixXd::Identity(3, 3)).norm(), 4 * kEpsilon);
}

}  // namespace
}  // namespace orthodyn::singular_vectors_test
