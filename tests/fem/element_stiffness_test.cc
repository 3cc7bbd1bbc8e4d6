// The stiffness of one element against the complex-step derivative of its node forces.
#include "lib/fem/element_stiffness.h"

#include <gtest/gtest.h>

#include "lib/core/symmetric_eigen.h"
#include "lib/element/linear_law.h"
#include "lib/element/tet4.h"
#include "lib/element/warped_law.h"
#include "tests/element/states.h"

namespace orthodyn::element_stiffness_test {
namespace {

using Matrix12 = Eigen::Matrix<double, 12, 12>;
using Nodes = Eigen::Matrix<double, 3, 4>;

const Mat3 kQ = Random(91).rotation();

Nodes random_tet(Random& random) {
  for (;;) {
    Nodes X;
    for (int a = 0; a < 4; ++a) X.col(a) = random.vector();
    const Mat3 e = X.rightCols<3>().colwise() - X.col(0);
    if (e.determinant() > 0.3) return X;
  }
}

template <class M>
auto edges(const M& x) {
  using T = typename M::Scalar;
  return Mat3T<T>(x.template rightCols<3>().colwise() - x.col(0));
}

// -df/dx, column by column; f_a = -V P g_a.
template <class Law>
Matrix12 derivative_of_forces(const Law& law, const ElementPoint<4>& shape, const Nodes& x) {
  Matrix12 K;
  for (int k = 0; k < 12; ++k) {
    Eigen::Matrix<Complex, 3, 4> stepped = x.cast<Complex>();
    stepped(k % 3, k / 3) += Complex(0, kComplexStep);
    const CMat3 F = edges(stepped) * shape.B.cast<Complex>();
    const Mat3 P = CMat3(law.template stress<Complex>(F, kQ)).imag() / kComplexStep;
    Nodes f;
    f.rightCols<3>() = -shape.volume * P * shape.B.transpose();
    f.col(0) = -f.rightCols<3>().rowwise().sum();
    K.col(k) = -f.reshaped();
  }
  return K;
}

Matrix12 assembled(const ElementBlocks<4>& blocks, bool symmetric) {
  Matrix12 K;
  for (int a = 0; a < 4; ++a)
    for (int b = 0; b < 4; ++b)
      K.block<3, 3>(3 * a, 3 * b) =
          symmetric && b > a ? Mat3(blocks[static_cast<std::size_t>(b)][static_cast<std::size_t>(a)].transpose())
                             : blocks[static_cast<std::size_t>(a)][static_cast<std::size_t>(b)];
  return K;
}

Matrix12 stiffness(const TangentForm& form, const ElementPoint<4>& shape, bool symmetric) {
  ElementBlocks<4> blocks;
  add_point_stiffness<4>(form, shape, symmetric, true, blocks);
  complete<4>(symmetric, blocks);
  return assembled(blocks, symmetric);
}

template <class Law>
void expect_derivative(const Law& law, double strain, bool symmetric) {
  Random random(92);
  for (int sample = 0; sample < 20; ++sample) {
    const Nodes X = random_tet(random);
    const ElementPoint<4> shape = Tet4::point(0, edges(X), kQ);
    const Nodes x = random_strain(random, strain).F() * X;
    const TangentForm form = law.tangent(shape.gradient(edges(x)), kQ, TangentKind::exact, 0, nullptr);
    const Matrix12 K = stiffness(form, shape, symmetric);
    const Matrix12 expected = derivative_of_forces(law, shape, x);
    EXPECT_LE((K - expected).norm(), 256 * kEps * expected.norm());
  }
}

TEST(ElementStiffness, IsTheDerivativeOfTheNodeForces) {
  expect_derivative(CorotationalLaw(fibre(10)), 0.3, true);
  expect_derivative(CorotationalLaw(fibre(10)), 0.3, false);
  expect_derivative(CorotationalLaw(stiffness(spruce())), 0.1, true);
}

TEST(ElementStiffness, OfAnIsotropicMaterialIsTheDerivativeOfTheNodeForces) {
  expect_derivative(CorotationalLaw(kIsotropic), 0.3, true);
}

TEST(ElementStiffness, OfTheWarpedForceIsItsUnsymmetricDerivative) {
  expect_derivative(WarpedLaw(fibre(10), WarpedTangent::unsymmetric), 0.2, false);
}

TEST(ElementStiffness, OfSmallStrainIsTheDerivativeOfTheNodeForces) {
  expect_derivative(LinearLaw(fibre(10)), 0.3, true);
}

// One element, masses V / 4: the bound is attained.
TEST(StrainGram, GivesTheElementsHighestFrequency) {
  Random random(93);
  const auto C = fibre(10);
  const Nodes X = random_tet(random);
  const ElementPoint<4> shape = Tet4::point(0, edges(X), kQ);
  const TangentForm form = LinearLaw(C).tangent(Mat3::Identity(), kQ, TangentKind::exact, 0, nullptr);
  const Matrix12 K = stiffness(form, shape, true);
  const double largest = symmetric_eigenvalues(Eigen::MatrixXd(K))[11] / (shape.volume / 4);
  const auto modes = symmetric_eigenpairs(voigt(C));
  const Mat6 root = modes.vectors * modes.values.cwiseSqrt().asDiagonal() * modes.vectors.transpose();
  const double from_gram = symmetric_eigenvalues(Mat6(root * strain_gram(shape, Tet4::kLumpedShares) * root))[5];
  EXPECT_NEAR(from_gram, largest, 1e-12 * largest);
}

}  // namespace
}  // namespace orthodyn::element_stiffness_test
