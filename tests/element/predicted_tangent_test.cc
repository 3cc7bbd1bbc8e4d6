// The tangent with predicted stress of the corotational law: its geometric part uses a stress predicted from an earlier
// state F0.
#include <gtest/gtest.h>

#include "lib/element/corotational_law.h"
#include "tests/element/states.h"

namespace orthodyn::predicted_tangent_test {
namespace {

const Mat3 kQ = Random(41).rotation();

template <class C>
Mat9 predicted(const C& stiffness, const Mat3& F0, const Mat3& F) {
  return in_space(CorotationalLaw<C>(stiffness).predicted_tangent(F0 - kQ, F - kQ, kQ));
}

template <class C>
Mat9 tangent(const C& stiffness, const Mat3& F, TangentKind kind) {
  return in_space(CorotationalLaw<C>(stiffness).tangent(F - kQ, kQ, kind, 0, nullptr));
}

TEST(PredictedTangent, IsTheExactOneWhereNothingHasMoved) {
  Random random(42);
  for (int sample = 0; sample < 10; ++sample) {
    const Mat3 F = random_strain(random, 0.3).F();
    const Mat9 exact = tangent(fibre(10), F, TangentKind::exact);
    EXPECT_LE((predicted(fibre(10), F, F) - exact).norm(), 64 * kEps * exact.norm());
  }
}

// The tangent with predicted stress minus its Gauss-Newton part is the second derivative of sigma : S(F) by F, for the
// fixed stress sigma = C (S0 - I + dS0) with S0 = S(F0) and dS0 its derivative in the direction F - F0. The first
// derivative is R (sigma + [c]) with the cross matrix [c].
template <class C>
void expect_second_derivative(const C& stiffness) {
  Random random(43);
  for (int sample = 0; sample < 10; ++sample) {
    const Mat3 F0 = random_strain(random, 0.3).F(), F = random_strain(random, 0.3).F();
    const auto p0 = polar(F0, kQ);
    const auto stretch = [](const Mat3T<Complex>& at) { return polar(at, kQ).S; };
    const Mat3 sigma = stiffness.stress(Mat3(p0.S - Mat3::Identity() + derivative(stretch, F0, Mat3(F - F0))));
    const auto gradient = [&](const Mat3T<Complex>& at) {
      const auto p = polar(at, kQ);
      const CMat3 s = sigma.cast<Complex>();
      const Vec3T<Complex> c = p.G_inverse * axial<Complex>(CMat3(p.S * s));
      return CMat3(p.R * (s + cross_matrix<Complex>(c)));
    };
    const Mat9 geometric = predicted(stiffness, F0, F) - tangent(stiffness, F, TangentKind::gauss_newton);
    for (int direction = 0; direction < 3; ++direction) {
      const Mat3 dF = random.matrix();
      const Mat3 expected = derivative(gradient, F, dF);
      const Mat3 found = (geometric * dF.reshaped()).reshaped(3, 3);
      EXPECT_LE((found - expected).norm(), 1e-12 * tangent(stiffness, F, TangentKind::exact).norm() * dF.norm());
    }
  }
}

TEST(PredictedTangent, HoldsTheStressThatTheTangentBeforePredicts) {
  expect_second_derivative(fibre(10));
  expect_second_derivative(kIsotropic);
  expect_second_derivative(turned(fibre(10), Random(44).rotation()));
}

TEST(PredictedTangent, IsTheExactOneWhereAnEndIsBlended) {
  const Mat3 inverted = Random(45).rotation() * Vec3(1.1, 0.8, -0.7).asDiagonal(), F = 1.1 * kQ;
  const Mat9 exact = tangent(fibre(10), F, TangentKind::exact);
  EXPECT_EQ((predicted(fibre(10), inverted, F) - exact).norm(), 0);
}

}  // namespace
}  // namespace orthodyn::predicted_tangent_test
