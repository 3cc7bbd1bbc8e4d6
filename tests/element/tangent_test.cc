// Tangents against the complex-step derivative of the stress.
#include <gtest/gtest.h>

#include <vector>

#include "lib/element/corotational_law.h"
#include "tests/element/states.h"

namespace orthodyn::tangent_test {
namespace {

const Mat3 kQ = Random(33).rotation();

// Principal stretches with chi = 1 (no blend): regular, flat and slightly inverted.
const std::vector<Vec3> kRegular{{1.6, 1, 0.6}, {1.05, 1, 0.98}, {1.2, 0.7, 0}, {1.2, 0.7, -0.1}};
const std::vector<Vec3> kBlended{{1.2, 0.8, -0.6}, {1.1, 0.8, -0.7}, {1.1, 0.8, -0.8}, {1, 0.03, 0.02}, {0, 0, 0}};

template <class C>
Mat9 tangent(const C& stiffness, const Mat3& F, TangentKind kind) {
  return in_space(CorotationalLaw<C>(stiffness).tangent(F - kQ, kQ, kind, 0, nullptr));
}

TEST(TangentForm, ExpandsToTheSameQuadraticForm) {
  Random random(34);
  TangentForm form;
  form.R = Mat3::Identity();
  form.Hee = stiffness(random_stable(random));
  form.Hea = Mat63::Random();
  form.Hae = Mat36::Random();
  form.Haa = Mat3::Random();
  const auto voigt_strain = [](const Mat3& X) {
    return (Vec6() << X(0, 0), X(1, 1), X(2, 2), X(0, 1) + X(1, 0), X(1, 2) + X(2, 1), X(2, 0) + X(0, 2)).finished();
  };
  for (int sample = 0; sample < 20; ++sample) {
    const Mat3 X = random.matrix(), Y = random.matrix();
    const Vec6 e = voigt_strain(X), f = voigt_strain(Y);
    const Vec3 a = axial<double>(X), b = axial<double>(Y);
    const double expected =
        f.dot(voigt(form.Hee) * e) + f.dot(form.Hea * a) + b.dot(form.Hae * e) + b.dot(form.Haa * a);
    EXPECT_NEAR(Y.reshaped().dot(expand(form) * X.reshaped()), expected, 1e-13 * expand(form).norm());
  }
}

template <class C>
void expect_tangent_is_the_derivative(const C& stiffness) {
  Random random(35);
  const CorotationalLaw<C> law(stiffness);
  for (const Vec3& s : kRegular)
    for (int sample = 0; sample < 10; ++sample) {
      const Mat3 F = random_state(random, s).F();
      const Mat9 H = tangent(stiffness, F, TangentKind::exact), J = stress_jacobian(law, F, kQ);
      EXPECT_LE((H - J).norm(), 64 * kEps * J.norm()) << s.transpose();
      EXPECT_LE(asymmetry(H), 1e-13);
    }
}

TEST(ExactTangent, IsTheSymmetricDerivativeOfTheStress) {
  expect_tangent_is_the_derivative(fibre(10));
  expect_tangent_is_the_derivative(fibre(1e6));
  expect_tangent_is_the_derivative(stiffness(spruce()));
}

TEST(ExactTangent, OfAnIsotropicMaterialIsTheDerivativeOfTheStress) { expect_tangent_is_the_derivative(kIsotropic); }

TEST(ExactTangent, OfAnAnisotropicMaterialIsTheSymmetricDerivativeOfTheStress) {
  expect_tangent_is_the_derivative(turned(fibre(10), Random(43).rotation()));
  expect_tangent_is_the_derivative(turned(stiffness(spruce()), Random(44).rotation()));
}

TEST(ExactTangent, AtARotationIsTheRotatedStiffness) {
  Random random(36);
  const Mat3 R = random.rotation();
  const auto C = fibre(100);
  const TangentForm linear{R, C, Mat63::Zero(), Mat36::Zero(), Mat3::Zero()};
  EXPECT_LE((tangent(C, R, TangentKind::exact) - in_space(linear)).norm(), 64 * kEps * voigt(C).norm());
}

TEST(ExactTangent, VanishesOnRigidRotationsUpToTheStress) {
  Random random(37);
  const auto C = fibre(100);
  const Mat3 F = random_strain(random, 0.3).F(), W = cross_matrix<double>(random.vector());
  const Mat3 P = CorotationalLaw(C).stress<double>(F - kQ, kQ);
  const Vector dP = tangent(C, F, TangentKind::exact) * Mat3(W * F).reshaped();
  EXPECT_LE((dP - Vector(Mat3(W * P).reshaped())).norm(), 256 * kEps * voigt(C).norm());
}

TEST(GaussNewtonTangent, EqualsTheExactOneAtARotation) {
  const Mat3 R = Random(38).rotation();
  const auto C = fibre(100);
  const Mat9 difference = tangent(C, R, TangentKind::exact) - tangent(C, R, TangentKind::gauss_newton);
  EXPECT_LE(difference.norm(), 64 * kEps * voigt(C).norm());
}

// The form must be dS : C : dS, with dS by a complex step through the polar decomposition.
TEST(GaussNewtonTangent, IsTheStiffnessOfTheRateOfStretch) {
  Random random(39);
  const auto C = fibre(100);
  for (const Vec3& s : kRegular) {
    const Mat3 F = random_state(random, s).F(), dF = random.matrix();
    const Mat3 dS = derivative([](const CMat3& G) { return polar(G, Mat3::Identity()).S; }, F, dF);
    const Mat9 H = tangent(C, F, TangentKind::gauss_newton);
    EXPECT_NEAR(dF.reshaped().dot(H * dF.reshaped()), contract<double>(C.stress<double>(dS), dS),
                1e-13 * H.norm() * dF.squaredNorm());
  }
}

TEST(GaussNewtonTangent, IsSymmetricPositiveSemidefinite) {
  Random random(40);
  for (const double ratio : {1.0, 100.0, 1e6})
    for (const Vec3& s : kRegular) {
      const Mat9 H = tangent(fibre(ratio), random_state(random, s).F(), TangentKind::gauss_newton);
      EXPECT_GE(smallest_eigenvalue(H), -16 * kEps);
      EXPECT_LE(asymmetry(H), 1e-13);
    }
}

TEST(BlendedTangent, IsSymmetricPositiveSemidefiniteOfBothKinds) {
  Random random(41);
  for (const TangentKind kind : {TangentKind::exact, TangentKind::gauss_newton})
    for (const Vec3& s : kBlended) {
      const Mat9 H = tangent(fibre(100), random_state(random, s).F(), kind);
      ASSERT_TRUE(H.allFinite());
      EXPECT_GE(smallest_eigenvalue(H), -16 * kEps) << s.transpose();
      EXPECT_LE(asymmetry(H), 1e-13);
    }
}

TEST(BlendedTangent, OfAnIsotropicMaterialIsPositiveSemidefiniteToo) {
  Random random(42);
  for (const Vec3& s : kBlended) {
    const Mat9 H = tangent(kIsotropic, random_state(random, s).F(), TangentKind::exact);
    EXPECT_GE(smallest_eigenvalue(H), -16 * kEps) << s.transpose();
  }
}

}  // namespace
}  // namespace orthodyn::tangent_test
