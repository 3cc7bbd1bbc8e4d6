// The 6x6 matrix of a change of basis, compared with the rotation of tensors.
#include <gtest/gtest.h>

#include "lib/material/stiffness.h"
#include "tests/material/constants.h"

namespace orthodyn::stress_rotation_test {
namespace {

// C'_ijkl = Q_ia Q_jb Q_kc Q_ld C_abcd
double rotated_component(const Mat6& C, const Mat3& Q, int i, int j, int k, int l) {
  double sum = 0;
  for (int a = 0; a < 3; ++a)
    for (int b = 0; b < 3; ++b)
      for (int c = 0; c < 3; ++c)
        for (int d = 0; d < 3; ++d) sum += Q(i, a) * Q(j, b) * Q(k, c) * Q(l, d) * component(C, a, b, c, d);
  return sum;
}

Mat6 rotated(const Mat6& C, const Mat3& Q) {
  const Mat6 K = stress_rotation(Q);
  return K * C * K.transpose();
}

TEST(StressRotation, RotatesCAsAFourthOrderTensor) {
  Random random(7);
  for (int sample = 0; sample < 20; ++sample) {
    const Mat6 C = voigt(stiffness(random_stable(random)));
    const Mat3 Q = random.rotation();
    const Mat6 R = rotated(C, Q);
    for (int ij = 0; ij < 9; ++ij)
      for (int kl = 0; kl < 9; ++kl)
        EXPECT_NEAR(component(R, ij / 3, ij % 3, kl / 3, kl % 3),
                    rotated_component(C, Q, ij / 3, ij % 3, kl / 3, kl % 3), 64 * kEps * C.norm());
  }
}

TEST(StressRotation, RotatesStressAsATensor) {
  Random random(8);
  const Mat3 Q = random.rotation(), A = random.matrix(), s = A + A.transpose();
  const auto vector = [](const Mat3& m) {
    return (Vec6() << m(0, 0), m(1, 1), m(2, 2), m(0, 1), m(1, 2), m(2, 0)).finished();
  };
  EXPECT_LE((stress_rotation(Q) * vector(s) - vector(Q * s * Q.transpose())).norm(), 32 * kEps);
}

TEST(StressRotation, OfTheTransposeIsTheInverse) {
  Random random(9);
  const Mat3 Q = random.rotation();
  const Mat6 product = stress_rotation(Q) * stress_rotation(Q.transpose());
  EXPECT_LE((product - Mat6::Identity()).cwiseAbs().maxCoeff(), 32 * kEps);
}

TEST(StressRotation, LeavesAnIsotropicCAlone) {
  Random random(10);
  const Mat6 C = voigt(as_orthotropic(IsotropicStiffness{2, 3}));
  EXPECT_LE((rotated(C, random.rotation()) - C).cwiseAbs().maxCoeff(), 64 * kEps * C.norm());
}

TEST(StressRotation, OfAxesWithFlippedSignsLeavesAnOrthotropicCAlone) {
  Random random(11);
  const Mat6 C = voigt(stiffness(spruce()));
  const Mat3 Q = random.rotation();
  const Mat6 R = rotated(C, Q);
  for (int signs = 1; signs < 8; ++signs) {
    const Vec3 flip(signs & 1 ? -1 : 1, signs & 2 ? -1 : 1, signs & 4 ? -1 : 1);
    EXPECT_LE((rotated(C, Q * flip.asDiagonal()) - R).cwiseAbs().maxCoeff(), 1e-15 * C.norm());
  }
}

TEST(Stiffness, StressIsTheVoigtMatrixTimesEngineeringStrain) {
  Random random(12);
  const auto C = stiffness(random_stable(random));
  const Mat3 A = random.matrix(), e = A + A.transpose(), s = C.stress<double>(e);
  const Vec6 strain = (Vec6() << e(0, 0), e(1, 1), e(2, 2), 2 * e(0, 1), 2 * e(1, 2), 2 * e(2, 0)).finished();
  const Vec6 stress = (Vec6() << s(0, 0), s(1, 1), s(2, 2), s(0, 1), s(1, 2), s(2, 0)).finished();
  EXPECT_LE((voigt(C) * strain - stress).norm(), 8 * kEps * voigt(C).norm() * strain.norm());
  EXPECT_EQ(s, s.transpose());
}

TEST(Stiffness, AnIsotropicOneGivesTheSameStressInItsOrthotropicForm) {
  Random random(13);
  const IsotropicStiffness iso{2, 3};
  const Mat3 A = random.matrix(), e = A + A.transpose();
  EXPECT_LE((iso.stress<double>(e) - as_orthotropic(iso).stress<double>(e)).norm(), 32 * kEps * e.norm());
}

TEST(Stiffness, SumsAndMultiplesAreThoseOfTheMatrices) {
  Random random(14);
  const auto a = stiffness(random_stable(random)), b = stiffness(random_stable(random));
  EXPECT_EQ(voigt(a + b), Mat6(voigt(a) + voigt(b)));
  EXPECT_EQ(voigt(3.0 * a), Mat6(3.0 * voigt(a)));
}

}  // namespace
}  // namespace orthodyn::stress_rotation_test
