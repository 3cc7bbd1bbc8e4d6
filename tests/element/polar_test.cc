// The polar decomposition F = R S for deformations from regular to degenerate.
#include "lib/element/polar.h"

#include <gtest/gtest.h>

#include <limits>
#include <string>

#include "lib/core/errors.h"
#include "tests/element/states.h"

namespace orthodyn::polar_test {
namespace {

struct Kind {
  std::string name;
  Vec3 s;
  double scale = 1;
};

class PolarOf : public testing::TestWithParam<Kind> {
 protected:
  // Calls check(F, polar decomposition of F) for random states with the tested stretches.
  template <class Check>
  void for_each(Check check) const {
    Random random(5);
    for (int sample = 0; sample < 200; ++sample) {
      const Mat3 F = GetParam().scale * random_state(random, GetParam().s).F();
      check(F, polar(F, random.rotation()));
    }
  }
};

INSTANTIATE_TEST_SUITE_P(
    Kinds, PolarOf,
    testing::Values(Kind{"regular", {1.6, 1, 0.6}}, Kind{"strain10", {1.1, 1.02, 0.9}}, Kind{"rest", {1, 1, 1}},
                    Kind{"plane", {1.2, 0.7, 0}}, Kind{"inverted", {1.2, 0.7, -0.4}}, Kind{"mirrored", {1, 1, -1}},
                    Kind{"mirrored_stretched", {1.1, 0.8, -0.8}}, Kind{"nearly_mirrored", {1, 1, -1 + 1e-5}},
                    Kind{"line", {1.3, 0, 0}}, Kind{"needle", {1, 1e-4, 1e-4}}, Kind{"gap", {1.1, 0.8, -0.8 + 1e-6}},
                    Kind{"disparate", {1e3, 1, 1e-3}}, Kind{"huge", {1.1, 1, 0.8}, 1e100},
                    Kind{"tiny", {1.1, 1, 0.8}, 1e-100}, Kind{"huge_inverted", {1.1, 1, -0.3}, 1e100}),
    [](const auto& tested) { return tested.param.name; });

TEST_P(PolarOf, ROfEachKindIsAProperRotation) {
  for_each([](const Mat3&, const Polar<double>& p) {
    EXPECT_LE((p.R.transpose() * p.R - Mat3::Identity()).cwiseAbs().maxCoeff(), 16 * kEps);
    EXPECT_NEAR(p.R.determinant(), 1, 16 * kEps);
  });
}

TEST_P(PolarOf, SOfEachKindIsSymmetric) {
  for_each([](const Mat3&, const Polar<double>& p) { EXPECT_EQ(p.S, p.S.transpose()); });
}

TEST_P(PolarOf, FOfEachKindIsRTimesS) {
  for_each([](const Mat3& F, const Polar<double>& p) {
    EXPECT_LE(((p.R * p.S - F) / GetParam().scale).norm(), 1e-13 * (F / GetParam().scale).norm());
  });
}

TEST_P(PolarOf, TheAxialVectorOfRTransposedFVanishesForEachKind) {
  for_each([](const Mat3& F, const Polar<double>& p) {
    const Mat3 unit = F / GetParam().scale;
    EXPECT_LE(axial<double>(p.R.transpose() * unit).norm(), 1e-13 * unit.norm());
  });
}

// R maximises tr(R^T F) over all rotations. The maximum is s1 + s2 + s3.
TEST_P(PolarOf, RIsTheNearestRotationForEachKind) {
  for_each([](const Mat3&, const Polar<double>& p) {
    const Vec3& s = GetParam().s;
    EXPECT_NEAR(p.S.trace() / GetParam().scale, s.sum(), 32 * kEps * s.norm());
  });
}

TEST_P(PolarOf, DetGOfEachKindIsTheProductOfTheSumsOfStretches) {
  for_each([](const Mat3&, const Polar<double>& p) {
    const Vec3& s = GetParam().s;
    const double expected = (s[0] + s[1]) * (s[1] + s[2]) * (s[2] + s[0]);
    const double norm = s.norm();
    EXPECT_NEAR(p.det_G / std::pow(GetParam().scale, 3), expected, 64 * kEps * norm * norm * norm);
    EXPECT_GE(p.det_G, 0);
  });
}

TEST(Polar, GInverseIsTheInverseOfG) {
  Random random(6);
  for (const Vec3& s : {Vec3(1.6, 1, 0.6), Vec3(1.2, 0.7, -0.4), Vec3(1.2, 0.7, 0)}) {
    const auto p = polar(random_state(random, s).F(), Mat3::Identity());
    const Mat3 G = p.S.trace() * Mat3::Identity() - p.S;
    EXPECT_LE((p.G_inverse * G - Mat3::Identity()).norm(), 64 * kEps * G.norm() / (s[1] + s[2]));
  }
}

TEST(Polar, KeepsTheRotationItWasBuiltFrom) {
  Random random(7);
  for (int sample = 0; sample < 200; ++sample) {
    const Deformation state = random_strain(random, 0.5);
    const auto p = polar(state.F(), Mat3::Identity());
    EXPECT_LE((p.R - state.R).norm(), 64 * kEps);
    EXPECT_LE((p.S - state.S()).norm(), 64 * kEps);
  }
}

TEST(Polar, TurnsWithTheState) {
  Random random(8);
  const Mat3 F = random_state(random, {1.2, 0.7, -0.4}).F(), R0 = random.rotation();
  const auto p = polar(F, Mat3::Identity()), turned = polar(Mat3(R0 * F), Mat3::Identity());
  EXPECT_LE((turned.R - R0 * p.R).norm(), 64 * kEps);
  EXPECT_LE((turned.S - p.S).norm(), 64 * kEps);
}

TEST(Polar, OfANumberThatIsNotFiniteIsRecoverable) {
  for (const double bad : {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
    Mat3 F = Mat3::Identity();
    F(1, 2) = bad;
    EXPECT_THROW(polar(F, Mat3::Identity()), RecoverableError);
  }
}

}  // namespace
}  // namespace orthodyn::polar_test
