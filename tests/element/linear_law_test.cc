// The small-strain law: its energy is quadratic and its tangent constant.
#include "lib/element/linear_law.h"

#include <gtest/gtest.h>

#include "tests/element/states.h"

namespace orthodyn::linear_law_test {
namespace {

const Mat3 kQ = Random(60).rotation();
constexpr double kBeta = 0.3;

TEST(LinearLaw, StressIsTheGradientOfTheEnergy) {
  Random random(61);
  const LinearLaw law(fibre(100));
  const Mat3 F = random.matrix();
  const Mat3 P = law.stress<double>(F - kQ, kQ);
  EXPECT_LE((P - energy_gradient(law, F, kQ)).norm(), 64 * kEps * P.norm());
}

TEST(LinearLaw, TangentIsTheDerivativeOfTheStressEverywhere) {
  Random random(62);
  const LinearLaw law(fibre(100));
  const Mat9 J = stress_jacobian(law, random.matrix(), kQ);
  for (const TangentKind kind : {TangentKind::exact, TangentKind::gauss_newton})
    EXPECT_LE((in_space(law.tangent(random.matrix() - kQ, kQ, kind, 0, nullptr)) - J).norm(), 64 * kEps * J.norm());
}

TEST(LinearLaw, AtRestIsFreeOfStress) {
  EXPECT_LE(LinearLaw(fibre(100)).stress<double>(Mat3::Zero(), kQ).norm(), 16 * kEps * voigt(fibre(100)).norm());
}

TEST(LinearLaw, DampingTangentIsTheDerivativeOfTheStressByTheRate) {
  Random random(63);
  const LinearLaw law(fibre(100));
  const Mat3 F = random.matrix(), rate = random.matrix();
  TangentForm damping;
  law.tangent(F - kQ, kQ, TangentKind::exact, kBeta, &damping);
  const Mat3 viscous = law.stress<double>(F - kQ, kQ, &rate, kBeta) - law.stress<double>(F - kQ, kQ);
  EXPECT_LE((Vector(viscous.reshaped()) - in_space(damping) * rate.reshaped()).norm(),
            64 * kEps * voigt(fibre(100)).norm());
}

TEST(LinearLaw, AgreesWithTheCorotationalLawToSecondOrderInTheDisplacement) {
  Random random(64);
  const auto C = fibre(10);
  const Mat3 H = random.matrix();
  const auto difference = [&](double h) {
    const Mat3 F = (Mat3::Identity() + h * H) * kQ;
    return (LinearLaw(C).stress<double>(F - kQ, kQ) - CorotationalLaw(C).stress<double>(F - kQ, kQ)).norm();
  };
  const double order = std::log2(difference(2e-4) / difference(1e-4));
  EXPECT_GT(order, 1.98);
  EXPECT_LT(order, 2.02);
}

TEST(LinearLaw, ObservesStressInSpaceAndStrainInMaterialAxes) {
  const Mat3 e = 1e-3 * Vec3(1, 2, -1).asDiagonal();  // in material axes
  const Mat3 F = kQ * (Mat3::Identity() + e);
  const auto seen = LinearLaw(fibre(10)).observe(F - kQ, kQ);
  EXPECT_LE((seen.strain - e).norm(), 16 * kEps);
  EXPECT_LE((seen.cauchy - kQ * fibre(10).stress<double>(e) * kQ.transpose()).norm(),
            64 * kEps * voigt(fibre(10)).norm());
  EXPECT_EQ(seen.axes, kQ);
}

}  // namespace
}  // namespace orthodyn::linear_law_test
