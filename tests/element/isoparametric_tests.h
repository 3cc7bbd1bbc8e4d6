// Properties of every isoparametric element. A test file instantiates the suite IsoparametricElement with a type
//
//   struct Case {
//     using Element = Hex20;
//     static constexpr int kZeroModes;            // motions of a free element without strain at the points
//     static constexpr bool kQuadraticIfBilinear;  // contains all quadratics if edges are straight and faces bilinear
//     static bool interpolates(int i, int j, int k);  // points_to_nodes() reproduces r^i s^j t^k
//   };
#pragma once

#include <gtest/gtest.h>

#include <cmath>

#include "lib/core/symmetric_eigen.h"
#include "lib/element/isoparametric.h"
#include "lib/element/quad4.h"
#include "lib/element/quad8.h"
#include "lib/element/quad9.h"
#include "lib/element/tri3.h"
#include "lib/element/tri6.h"
#include "tests/material/constants.h"

namespace orthodyn::isoparametric_tests {

// Gauss-Legendre rule on [-1, 1] from the eigenpairs of the Jacobi matrix (Golub & Welsch 1969).
inline std::vector<LinePoint> gauss_legendre(int n) {
  Eigen::MatrixXd jacobi = Eigen::MatrixXd::Zero(n, n);
  for (int k = 1; k < n; ++k) jacobi(k, k - 1) = jacobi(k - 1, k) = k / std::sqrt(4.0 * k * k - 1);
  const auto [x, vectors] = symmetric_eigenpairs<Eigen::Dynamic>(jacobi);
  std::vector<LinePoint> points;
  for (int k = 0; k < n; ++k) points.push_back({x[k], 2 * vectors(0, k) * vectors(0, k)});
  return points;
}

template <class E>
constexpr bool kIsWedge =
    E::kShape == CellShape::wedge6 || E::kShape == CellShape::wedge15 || E::kShape == CellShape::wedge18;

// Points of high degree, which are independent of the element's; in collapsed coordinates for wedges.
template <class E>
std::vector<QuadraturePoint> fine_points() {
  const std::vector<LinePoint> line = gauss_legendre(7);
  std::vector<QuadraturePoint> points;
  for (const auto& [x, w_x] : line)
    for (const auto& [y, w_y] : line)
      for (const auto& [z, w_z] : line) {
        const double r = (1 + x) / 2, s = (1 - r) * (1 + y) / 2, weight = w_x * w_y * w_z;
        if (kIsWedge<E>) points.push_back({{r, s, z}, weight * (1 - r) / 4});
        else points.push_back({{x, y, z}, weight});
      }
  return points;
}

template <class E>
double fine_volume(const ElementNodes<E::kNodes>& X) {
  double volume = 0;
  for (const auto& [xi, weight] : fine_points<E>())
    volume += weight * E::jacobian(differences<E::kNodes>(X), xi).determinant();
  return volume;
}

// The integral of N_a N_b over the reference cell.
template <class E>
Eigen::MatrixXd reference_mass() {
  Eigen::MatrixXd M = Eigen::MatrixXd::Zero(E::kNodes, E::kNodes);
  for (const auto& [xi, weight] : fine_points<E>()) M += weight * E::shape(xi) * E::shape(xi).transpose();
  return M;
}

inline Mat3 random_map(Random& random) {
  for (;;) {
    const Mat3 A = Mat3::Identity() + 0.5 * random.matrix();
    if (A.determinant() > 0.3) return A;
  }
}

template <class E>
ElementNodes<E::kNodes> affine(const Mat3& A, const Vec3& shift) {
  return (A * E::nodes()).colwise() + shift;
}

template <class E>
ElementNodes<E::kNodes> random_affine(Random& random) {
  return affine<E>(random_map(random), random.vector());
}

// Straight edges and bilinear faces.
template <class E>
ElementNodes<E::kNodes> random_bilinear(Random& random) {
  Eigen::Matrix3Xd corners = E::nodes().leftCols(topology(E::kShape).corners);
  for (auto corner : corners.colwise()) corner += 0.15 * random.vector();
  return random_map(random) * nodes_from_corners<E::kNodes>(E::kShape, corners);
}

template <class E>
ElementNodes<E::kNodes> random_curved(Random& random) {
  ElementNodes<E::kNodes> X = random_bilinear<E>(random);
  for (auto node : X.colwise()) node += 0.04 * random.vector();
  return X;
}

// A place inside the reference cell.
template <class E>
Vec3 random_place(Random& random) {
  const Vec3 xi = random.vector();
  return kIsWedge<E> ? Vec3((1 + xi[0]) / 4, (1 + xi[1]) / 4, xi[2]) : xi;
}

// The largest relative error of the gradient A + (c . X) B + B X c^T of the field u = A X + (c . X) B X.
template <class E>
double error_of_quadratic_field(const ElementNodes<E::kNodes>& X, Random& random) {
  const Mat3 Q = random.rotation(), A = random.matrix(), B = random.matrix();
  const Vec3 c = random.vector();
  ElementNodes<E::kNodes> u;
  for (int a = 0; a < E::kNodes; ++a) u.col(a) = A * X.col(a) + c.dot(X.col(a)) * (B * X.col(a));
  double error = 0;
  for (int p = 0; p < E::kPoints; ++p) {
    const Vec3 at = E::place_of(p, X);
    const Mat3 expected = (A + c.dot(at) * B + B * at * c.transpose()) * Q;
    const auto point = E::point(p, differences<E::kNodes>(X), Q);
    error = std::max(error, (point.gradient(differences<E::kNodes>(u)) - expected).norm() / expected.norm());
  }
  return error;
}

// Stiffness of an isotropic material: integral of lambda tr(e)^2 + 2 mu e:e for the strain e.
template <class E>
Eigen::MatrixXd isotropic_stiffness(const ElementNodes<E::kNodes>& X,
                                    const std::vector<QuadraturePoint>& points = E::points()) {
  Mat6 C = 0.6 * Mat6::Identity();  // 2 mu = 0.6, lambda = 0.4
  C.topLeftCorner<3, 3>().array() += 0.4;
  Eigen::MatrixXd K = Eigen::MatrixXd::Zero(3 * E::kNodes, 3 * E::kNodes);
  for (const QuadraturePoint& at : points) {
    const auto point = E::point(at, differences<E::kNodes>(X), Mat3::Identity());
    Eigen::MatrixXd strain(6, 3 * E::kNodes);  // e11, e22, e33, sqrt(2) e12, sqrt(2) e23, sqrt(2) e31
    for (int a = 0; a < E::kNodes; ++a) {
      const Vec3 g = a == 0 ? Vec3(-point.B.colwise().sum()) : Vec3(point.B.row(a - 1));
      for (int i = 0; i < 3; ++i) {
        const Mat3 e = (Vec3::Unit(i) * g.transpose() + g * Vec3::Unit(i).transpose()) / 2;
        strain.col(3 * a + i) << e.diagonal(), std::sqrt(2) * Vec3(e(0, 1), e(1, 2), e(2, 0));
      }
    }
    K += point.volume * strain.transpose() * C * strain;
  }
  return K;
}

// Number of eigenvalues that are zero to round-off; fails if it is not clear which ones are.
inline int zero_modes(const Eigen::MatrixXd& K) {
  const Vector values = symmetric_eigenvalues<Eigen::Dynamic>(K) / K.norm();
  int count = 0;
  for (const double value : values) {
    EXPECT_TRUE(value < 1e-13 || value > 1e-6) << value;
    count += value < 1e-13;
  }
  return count;
}

// Calls test(F(), nodes) for each face of E.
template <class E, class Test>
void for_each_face(const Test& test) {
  for (const std::vector<int>& nodes : topology(E::kShape).faces) switch (nodes.size()) {
      case 3: test(Tri3(), nodes); break;
      case 4: test(Quad4(), nodes); break;
      case 6: test(Tri6(), nodes); break;
      case 8: test(Quad8(), nodes); break;
      case 9: test(Quad9(), nodes); break;
      default: FAIL() << nodes.size();
    }
}

template <class Case>
class IsoparametricElement : public testing::Test {};
TYPED_TEST_SUITE_P(IsoparametricElement);

TYPED_TEST_P(IsoparametricElement, HasAsManyNodesAndPointsAsItSays) {
  using E = typename TypeParam::Element;
  EXPECT_EQ(topology(E::kShape).nodes, E::kNodes);
  EXPECT_EQ(E::points().size(), static_cast<std::size_t>(E::kPoints));
  EXPECT_EQ(E::checked_places().size(), static_cast<std::size_t>(E::kNodes + E::kPoints) + E::mass_points().size());
}

TYPED_TEST_P(IsoparametricElement, ShapeFunctionsAreOneAtTheirNodeAndZeroAtTheOthers) {
  using E = typename TypeParam::Element;
  for (int a = 0; a < E::kNodes; ++a) EXPECT_LE((E::shape(E::nodes().col(a)) - E::Values::Unit(a)).norm(), kEps) << a;
}

TYPED_TEST_P(IsoparametricElement, ShapeFunctionsSumToOne) {
  using E = typename TypeParam::Element;
  Random random(411);
  const Vec3 xi = random_place<E>(random);
  EXPECT_NEAR(E::shape(xi).sum(), 1, 1e-14);
  EXPECT_LE(E::shape_slopes(xi).colwise().sum().norm(), 1e-14);
}

TYPED_TEST_P(IsoparametricElement, SlopesAreThoseOfTheShapeFunctions) {
  using E = typename TypeParam::Element;
  Random random(412);
  const Vec3 xi = random_place<E>(random), along = random.vector().normalized();
  const auto error = [&](double h) {
    const typename E::Values difference = (E::shape(xi + h * along) - E::shape(xi - h * along)) / (2 * h);
    return (difference - E::shape_slopes(xi) * along).norm();
  };
  if (E::kShape == CellShape::wedge6) EXPECT_LE(error(0.02), 1e-13);  // bilinear along a line: differences are exact
  else EXPECT_NEAR(std::log2(error(0.02) / error(0.01)), 2, 0.01);
}

TYPED_TEST_P(IsoparametricElement, OfALinearFieldHasItsGradientInMaterialAxesAlsoWhereItIsCurved) {
  using E = typename TypeParam::Element;
  Random random(413);
  const auto X = random_curved<E>(random);
  const Mat3 Q = random.rotation(), A = random.matrix();
  for (int p = 0; p < E::kPoints; ++p) {
    const auto point = E::point(p, differences<E::kNodes>(X), Q);
    EXPECT_LE((point.gradient(differences<E::kNodes>(ElementNodes<E::kNodes>(A * X))) - A * Q).norm(), 1e-12);
  }
}

TYPED_TEST_P(IsoparametricElement, OfAQuadraticFieldHasItsGradientInAnAffineCell) {
  using E = typename TypeParam::Element;
  if (E::kDegree < 2) return;
  Random random(414);
  for (int sample = 0; sample < 10; ++sample)
    EXPECT_LE(error_of_quadratic_field<E>(random_affine<E>(random), random), 1e-12);
}

TYPED_TEST_P(IsoparametricElement, OfAQuadraticFieldHasItsGradientInABilinearCellIfItSaysSo) {
  using E = typename TypeParam::Element;
  Random random(415);
  for (int sample = 0; sample < 10; ++sample) {
    const double error = error_of_quadratic_field<E>(random_bilinear<E>(random), random);
    if (TypeParam::kQuadraticIfBilinear) EXPECT_LE(error, 1e-12);
    else EXPECT_GE(error, 1e-5);
  }
}

TYPED_TEST_P(IsoparametricElement, PlacesOfItsPointsAreMappedWithTheCell) {
  using E = typename TypeParam::Element;
  Random random(416);
  const Mat3 A = random_map(random);
  const Vec3 shift = random.vector();
  for (int p = 0; p < E::kPoints; ++p)
    EXPECT_LE((E::place_of(p, affine<E>(A, shift)) - (A * E::place(p) + shift)).norm(), 1e-14);
}

TYPED_TEST_P(IsoparametricElement, PointsShareTheVolumeOfAnAffineCell) {
  using E = typename TypeParam::Element;
  Random random(417);
  const Mat3 A = random_map(random);
  const auto X = affine<E>(A, random.vector());
  const double volume = A.determinant() * (kIsWedge<E> ? 1 : 8);
  double sum = 0;
  for (int p = 0; p < E::kPoints; ++p) sum += E::point(p, differences<E::kNodes>(X), Mat3::Identity()).volume;
  EXPECT_NEAR(sum, volume, 1e-13 * volume);
  EXPECT_NEAR(E::mass(X, 3), 3 * volume, 1e-13 * volume);
}

TYPED_TEST_P(IsoparametricElement, HasTheMassOfItsCurvedShape) {
  using E = typename TypeParam::Element;
  Random random(418);
  const auto X = random_curved<E>(random);
  const auto corners = X.leftCols(topology(E::kShape).corners);
  const double mass = E::mass(X, 3), straight = E::mass(nodes_from_corners<E::kNodes>(E::kShape, corners), 3);
  EXPECT_NEAR(mass, 3 * fine_volume<E>(X), 1e-13 * mass);
  if (E::kDegree > 1) {
    EXPECT_GT(std::abs(mass - straight), 1e-3 * mass);
  }
  EXPECT_NEAR(E::consistent_mass(X, 3).sum(), mass, 1e-13 * mass);
}

// By the divergence theorem, the integral of x . n over all faces is three times the volume.
TYPED_TEST_P(IsoparametricElement, IsEnclosedByItsFaces) {
  using E = typename TypeParam::Element;
  Random random(419);
  const auto X = random_curved<E>(random);
  double flux = 0;
  for_each_face<E>([&]<class F>(F, const std::vector<int>& nodes) {
    const FaceNodes<F> at = X(Eigen::all, nodes);
    double outward = 0;
    for (const auto& [place, weight] : F::points()) {
      const Vec3 normal = weight * normal_at<F>(at, place), x = at * F::shape(place);
      flux += x.dot(normal);
      outward += (x - X.rowwise().mean()).dot(normal);
    }
    EXPECT_GT(outward, 0);
  });
  EXPECT_NEAR(flux, 3 * E::mass(X, 1), 1e-13 * flux);
}

TYPED_TEST_P(IsoparametricElement, HasTheShapeFunctionsOfItsFaces) {
  using E = typename TypeParam::Element;
  for_each_face<E>([]<class F>(F, const std::vector<int>& nodes) {
    const FaceNodes<F> at = E::nodes()(Eigen::all, nodes);
    for (const auto& [place, weight] : F::points()) {
      typename E::Values expected = E::Values::Zero();
      expected(nodes) = F::shape(place);
      EXPECT_LE((E::shape(at * F::shape(place)) - expected).norm(), 1e-14);
    }
  });
}

TYPED_TEST_P(IsoparametricElement, ConsistentMassOfAnAffineCellIsExact) {
  using E = typename TypeParam::Element;
  Random random(420);
  const Mat3 A = random_map(random);
  const Eigen::MatrixXd expected = 2 * A.determinant() * reference_mass<E>();
  EXPECT_LE((E::consistent_mass(affine<E>(A, random.vector()), 2) - expected).norm(), 1e-13 * expected.norm());
}

// Second moments of the reference cells about their centroids: 1/3 in [-1, 1], 1/18 and -1/36 in the unit triangle.
TYPED_TEST_P(IsoparametricElement, ConsistentMassHasTheMomentsOfAnAffineCell) {
  using E = typename TypeParam::Element;
  Random random(421);
  const Mat3 A = random_map(random);
  const auto X = affine<E>(A, random.vector());
  const auto M = E::consistent_mass(X, 2);
  const double m = E::mass(X, 2);
  Mat3 moments = Mat3::Identity() / 3;
  if (kIsWedge<E>) moments.topLeftCorner<2, 2>() << 1.0 / 18, -1.0 / 36, -1.0 / 36, 1.0 / 18;
  const Vec3 centroid = X.leftCols(topology(E::kShape).corners).rowwise().mean();
  EXPECT_LE((X * M.rowwise().sum() - m * centroid).norm(), 1e-13 * m);
  const Mat3 expected = m * (A * moments * A.transpose() + centroid * centroid.transpose());
  EXPECT_LE((X * M * X.transpose() - expected).norm(), 1e-13 * expected.norm());
}

TYPED_TEST_P(IsoparametricElement, ConsistentMassOfACurvedCellIsPositiveDefinite) {
  using E = typename TypeParam::Element;
  Random random(422);
  const auto X = random_curved<E>(random);
  const Eigen::MatrixXd exact = reference_mass<E>() * E::mass(X, 1) / reference_mass<E>().sum();
  const Vector ratios = symmetric_eigenvalues(Eigen::MatrixXd(E::consistent_mass(X, 1)), exact);
  EXPECT_GT(ratios[0], 0.2);
  EXPECT_LT(ratios[E::kNodes - 1], 5);
}

TYPED_TEST_P(IsoparametricElement, LumpedSharesAreTheScaledDiagonalOfAnAffineCellAndSumToOne) {
  using E = typename TypeParam::Element;
  const Vector diagonal = reference_mass<E>().diagonal();
  double sum = 0;
  for (int a = 0; a < E::kNodes; ++a) {
    const double share = E::kLumpedShares[static_cast<std::size_t>(a)];
    EXPECT_NEAR(share, diagonal[a] / diagonal.sum(), 1e-14) << a;
    sum += share;
  }
  EXPECT_NEAR(sum, 1, 1e-15);
}

TYPED_TEST_P(IsoparametricElement, LumpedEnergyExceedsConsistentByNoMoreThanItSays) {
  using E = typename TypeParam::Element;
  const Eigen::MatrixXd M = reference_mass<E>();
  const Vector shares = Eigen::Map<const Vector>(E::kLumpedShares.data(), E::kNodes);
  const Eigen::MatrixXd lumped = (M.sum() * shares).asDiagonal();
  EXPECT_NEAR(symmetric_eigenvalues(lumped, M).maxCoeff(), E::kLumpedToConsistent, 1e-11);
}

TYPED_TEST_P(IsoparametricElement, PointsToNodesReproducesThePolynomialsThroughThePoints) {
  using E = typename TypeParam::Element;
  int reproduced = 0;
  for (int i = 0; i <= 2; ++i)
    for (int j = 0; j <= 2; ++j)
      for (int k = 0; k <= 2; ++k) {
        if (!TypeParam::interpolates(i, j, k)) continue;
        const auto polynomial = [&](const Vec3& xi) {
          return std::pow(xi[0], i) * std::pow(xi[1], j) * std::pow(xi[2], k);
        };
        Vector at_points(E::kPoints), at_nodes(E::kNodes);
        for (int p = 0; p < E::kPoints; ++p) at_points[p] = polynomial(E::place(p));
        for (int a = 0; a < E::kNodes; ++a) at_nodes[a] = polynomial(E::nodes().col(a));
        EXPECT_LE((E::points_to_nodes() * at_points - at_nodes).norm(), 1e-13) << i << j << k;
        ++reproduced;
      }
  EXPECT_EQ(reproduced, E::kPoints);
}

TYPED_TEST_P(IsoparametricElement, HasTheZeroEnergyModesThatItSays) {
  using E = typename TypeParam::Element;
  Random random(423);
  EXPECT_EQ(zero_modes(isotropic_stiffness<E>(random_affine<E>(random))), TypeParam::kZeroModes);
  EXPECT_EQ(zero_modes(isotropic_stiffness<E>(random_curved<E>(random))), TypeParam::kZeroModes);
}

TYPED_TEST_P(IsoparametricElement, HasPositiveJacobiansWhereItIsSlightlyCurved) {
  using E = typename TypeParam::Element;
  Random random(424);
  const auto X = random_curved<E>(random);
  for (const Vec3& xi : E::checked_places())
    EXPECT_GT(E::jacobian(differences<E::kNodes>(X), xi).determinant(), 0) << xi.transpose();
}

REGISTER_TYPED_TEST_SUITE_P(
    IsoparametricElement, HasAsManyNodesAndPointsAsItSays, ShapeFunctionsAreOneAtTheirNodeAndZeroAtTheOthers,
    ShapeFunctionsSumToOne, SlopesAreThoseOfTheShapeFunctions,
    OfALinearFieldHasItsGradientInMaterialAxesAlsoWhereItIsCurved, OfAQuadraticFieldHasItsGradientInAnAffineCell,
    OfAQuadraticFieldHasItsGradientInABilinearCellIfItSaysSo, PlacesOfItsPointsAreMappedWithTheCell,
    PointsShareTheVolumeOfAnAffineCell, HasTheMassOfItsCurvedShape, IsEnclosedByItsFaces,
    HasTheShapeFunctionsOfItsFaces, ConsistentMassOfAnAffineCellIsExact, ConsistentMassHasTheMomentsOfAnAffineCell,
    ConsistentMassOfACurvedCellIsPositiveDefinite, LumpedSharesAreTheScaledDiagonalOfAnAffineCellAndSumToOne,
    LumpedEnergyExceedsConsistentByNoMoreThanItSays, PointsToNodesReproducesThePolynomialsThroughThePoints,
    HasTheZeroEnergyModesThatItSays, HasPositiveJacobiansWhereItIsSlightlyCurved);

}  // namespace orthodyn::isoparametric_tests
