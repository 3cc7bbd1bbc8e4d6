#include "lib/element/tet10.h"

#include <gtest/gtest.h>

#include <cmath>

#include "lib/core/symmetric_eigen.h"
#include "tests/element/states.h"

namespace orthodyn::tet10_test {
namespace {

using Nodes = ElementNodes<Tet10::kNodes>;
using Places = Eigen::Matrix<double, 10, 4>;

// Barycentric coordinates of the nodes.
Places node_places() {
  Places all = Places::Zero();
  all.topRows<4>().setIdentity();
  for (int e = 0; e < 6; ++e)
    for (const int corner : Tet10::kEdges[static_cast<std::size_t>(e)]) all(4 + e, corner) = 0.5;
  return all;
}

Nodes straight(const Eigen::Matrix<double, 3, 4>& corners) { return corners * node_places().transpose(); }

Nodes random_straight(Random& random) {
  for (;;) {
    Eigen::Matrix<double, 3, 4> corners;
    corners << random.matrix(), random.vector();
    if ((corners.rightCols<3>().colwise() - corners.col(0)).determinant() > 0.05) return straight(corners);
  }
}

Nodes random_curved(Random& random) {
  Nodes X = random_straight(random);
  for (Eigen::Index a = 4; a < 10; ++a) X.col(a) += 0.02 * random.vector();
  return X;
}

// The integral of L^powers over a tetrahedron of volume 1/6.
double exact(const std::array<int, 4>& powers) {
  double product = 1;
  int sum = 3;
  for (const int p : powers) product *= std::tgamma(p + 1), sum += p;
  return product / std::tgamma(sum + 1);
}

double by_points(const std::array<int, 4>& powers) {
  double sum = 0;
  for (const auto& [L, weight] : tetrahedron_points_of_degree_7()) {
    double product = weight;
    for (int i = 0; i < 4; ++i) product *= std::pow(L[i], powers[static_cast<std::size_t>(i)]);
    sum += product;
  }
  return sum;
}

TEST(TetrahedronPoints, IntegratePolynomialsOfDegreeSevenExactly) {
  for (int a = 0; a <= 7; ++a)
    for (int b = 0; a + b <= 7; ++b)
      for (int c = 0; a + b + c <= 7; ++c)
        for (int d = 0; a + b + c + d <= 7; ++d)
          EXPECT_NEAR(by_points({a, b, c, d}), exact({a, b, c, d}), 1e-13 * exact({a, b, c, d})) << a << b << c << d;
}

TEST(Tet10, ShapeFunctionsAreOneAtTheirNodeAndZeroAtTheOthers) {
  const Places at = node_places();
  for (int a = 0; a < 10; ++a) EXPECT_LE((Tet10::shape(at.row(a)) - Tet10::Values::Unit(a)).norm(), kEps) << a;
}

TEST(Tet10, SlopesAreThoseOfTheShapeFunctions) {
  const Eigen::Vector4d L(0.1, 0.2, 0.3, 0.4);
  for (int i = 0; i < 3; ++i) {
    Eigen::Vector4d along = Eigen::Vector4d::Zero();
    along[0] = -1e-4;
    along[i + 1] = 1e-4;
    // Exact, because shape functions are quadratic.
    const Tet10::Values difference = (Tet10::shape(L + along) - Tet10::shape(L - along)) / 2e-4;
    EXPECT_LE((difference - Tet10::shape_slopes(L).col(i)).norm(), 1e-11);
  }
}

TEST(Tet10, OfAQuadraticFieldHasItsGradientInMaterialAxes) {
  Random random(401);
  for (int sample = 0; sample < 20; ++sample) {
    const Nodes X = random_straight(random);
    const Mat3 Q = random.rotation(), A = random.matrix(), B = random.matrix();
    const Vec3 c = random.vector();
    // The field u = A X + (c . X) B X has the gradient A + (c . X) B + B X c^T.
    Nodes u;
    for (Eigen::Index a = 0; a < 10; ++a) u.col(a) = A * X.col(a) + c.dot(X.col(a)) * (B * X.col(a));
    for (int p = 0; p < Tet10::kPoints; ++p) {
      const Vec3 at = X * Tet10::shape(Tet10::place(p));
      const Mat3 expected = (A + c.dot(at) * B + B * at * c.transpose()) * Q;
      const auto point = Tet10::point(p, differences<10>(X), Q);
      EXPECT_LE((point.gradient(differences<10>(u)) - expected).norm(), 1e-12 * point.B.norm() * u.norm());
    }
  }
}

TEST(Tet10, AtRestHasTheMaterialAxesAsGradientAlsoWhereItIsCurved) {
  Random random(402);
  const Nodes X = random_curved(random);
  const Mat3 Q = random.rotation();
  for (int p = 0; p < Tet10::kPoints; ++p)
    EXPECT_LE((Tet10::point(p, differences<10>(X), Q).gradient(differences<10>(X)) - Q).norm(), 1e-12);
}

TEST(Tet10, PointsShareTheVolumeOfStraightEdges) {
  Random random(403);
  const Nodes X = random_straight(random);
  double sum = 0;
  for (int p = 0; p < Tet10::kPoints; ++p) sum += Tet10::point(p, differences<10>(X), Mat3::Identity()).volume;
  const double volume = (X.middleCols<3>(1).colwise() - X.col(0)).determinant() / 6;
  EXPECT_NEAR(sum, volume, 1e-14);
  EXPECT_NEAR(Tet10::mass(X, 3), 3 * volume, 1e-14);
}

// Entries of 420 M / m, with the mass matrix M and the mass m. Two corners: 6 if they are equal, else 1. A corner and
// an edge node: -4 if the corner is on the edge, else -6. Two edge nodes: 32 if they are equal, 16 if their edges share
// a corner, else 8.
TEST(Tet10, HasTheConsistentMassOfStraightEdges) {
  Random random(404);
  const Nodes X = random_straight(random);
  const double m = Tet10::mass(X, 2);
  const Eigen::MatrixXd M = Tet10::consistent_mass(X, 2) * 420 / m;
  const auto shared = [](std::size_t e, std::size_t f) {
    int count = 0;
    for (const int i : Tet10::kEdges[e])
      for (const int j : Tet10::kEdges[f]) count += i == j;
    return count;
  };
  for (int i = 0; i < 4; ++i)
    for (int j = 0; j < 4; ++j) EXPECT_NEAR(M(i, j), i == j ? 6 : 1, 1e-11);
  for (std::size_t e = 0; e < 6; ++e) {
    const auto row = static_cast<Eigen::Index>(4 + e);
    for (int i = 0; i < 4; ++i) {
      const bool own = Tet10::kEdges[e][0] == i || Tet10::kEdges[e][1] == i;
      EXPECT_NEAR(M(row, i), own ? -4 : -6, 1e-11);
    }
    for (std::size_t f = 0; f < 6; ++f) {
      const double expected[] = {8, 16, 32};
      EXPECT_NEAR(M(row, static_cast<Eigen::Index>(4 + f)), expected[shared(e, f)], 1e-11);
    }
  }
}

TEST(Tet10, LumpedSharesAreTheScaledDiagonalAndSumToOne) {
  Random random(405);
  const Vector diagonal = Tet10::consistent_mass(random_straight(random), 1).diagonal();
  double sum = 0;
  for (Eigen::Index a = 0; a < 10; ++a) {
    sum += Tet10::kLumpedShares[static_cast<std::size_t>(a)];
    EXPECT_NEAR(Tet10::kLumpedShares[static_cast<std::size_t>(a)], diagonal[a] / diagonal.sum(), 1e-14);
  }
  EXPECT_NEAR(sum, 1, 1e-15);
}

TEST(Tet10, LumpedEnergyExceedsConsistentByNoMoreThanItSays) {
  Random random(406);
  const Eigen::MatrixXd M = Tet10::consistent_mass(random_straight(random), 1);
  const Vector root = Eigen::Map<const Vector>(Tet10::kLumpedShares.data(), 10).cwiseSqrt() * std::sqrt(M.sum());
  const Eigen::MatrixXd scaled = root.asDiagonal().inverse() * M * root.asDiagonal().inverse();
  EXPECT_NEAR(1 / symmetric_eigenvalues(scaled)[0], Tet10::kLumpedToConsistent, 1e-10);
}

// Computes the volume, the integral of det dX/dL, by a midpoint rule that is independent of the element's points.
TEST(Tet10, HasTheMassOfItsCurvedShape) {
  Random random(407);
  const Nodes X = random_curved(random);
  double volume = 0;
  constexpr int kParts = 40;  // midpoint rule: error of order 1/kParts^2
  for (int i = 0; i < kParts; ++i)
    for (int j = 0; j < kParts - i; ++j)
      for (int k = 0; k < kParts - i - j; ++k) {
        // A cube of the grid, or the part of it inside the tetrahedron: six, five or one sixth of the cube.
        const int rest = kParts - i - j - k;
        const double part = rest >= 3 ? 1 : rest == 2 ? 5.0 / 6 : 1.0 / 6;
        const double middle = rest >= 3 ? 0.5 : rest == 2 ? 0.45 : 0.25;
        const Vec3 at = (Vec3(i, j, k) + Vec3::Constant(middle)) / kParts;
        volume += part * Tet10::jacobian(differences<10>(X), {1 - at.sum(), at[0], at[1], at[2]}).determinant();
      }
  EXPECT_NEAR(volume / std::pow(kParts, 3), Tet10::mass(X, 1), 1e-3 * Tet10::mass(X, 1));
  EXPECT_GT(std::abs(Tet10::mass(X, 1) - Tet10::mass(straight(X.leftCols<4>()), 1)), 2e-3 * Tet10::mass(X, 1));
}

}  // namespace
}  // namespace orthodyn::tet10_test
