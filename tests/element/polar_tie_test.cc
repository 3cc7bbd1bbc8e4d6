// Where R is not unique, the choice of R must not depend on round-off, so that all elements choose alike.
#include <gtest/gtest.h>

#include <vector>

#include "lib/element/polar.h"
#include "tests/element/states.h"

namespace orthodyn::polar_tie_test {
namespace {

// F without a unique R: mirrored along one axis or all, mirrored and stretched, collapsed to a line, to a point.
const std::vector<Mat3> kTied{Mat3(Vec3(-1, 1, 1).asDiagonal()),
                              Mat3(Vec3(1, -1, 1).asDiagonal()),
                              Mat3(-Mat3::Identity()),
                              Mat3(Vec3(1.1, 0.8, -0.8).asDiagonal()),
                              Mat3(Vec3(2, 0, 0).asDiagonal()),
                              Mat3(Vec3(-2, 0, 0).asDiagonal()),
                              Mat3(Mat3::Zero())};

TEST(PolarTie, OfAPointIsTheTieItself) {
  const Mat3 tie = Random(9).rotation();
  const Mat3 point = Mat3::Zero();
  const auto p = polar(point, tie);
  EXPECT_EQ(p.R, tie);
  EXPECT_EQ(p.S, point);
  EXPECT_EQ(p.det_G, 0);
}

TEST(PolarTie, IsBrokenTheSameWayUnderRoundOffNoise) {
  Random random(10);
  for (const Mat3& F : kTied) {
    if (F.isZero()) continue;  // only noise would be left
    const Mat3 R = polar(F, Mat3::Identity()).R;
    for (int sample = 0; sample < 50; ++sample) {
      const Mat3 noisy = F + 1e-14 * random.matrix();
      EXPECT_LE((polar(noisy, Mat3::Identity()).R - R).norm(), 1e-12) << F;
    }
  }
}

TEST(PolarTie, IsBrokenInSpaceAndNotInMaterialAxes) {
  Random random(11);
  for (const Mat3& F : kTied) {
    const Mat3 Q = random.rotation();
    EXPECT_LE((polar(Mat3(F * Q), Q).R - polar(F, Mat3::Identity()).R * Q).norm(), 1e-12) << F;
  }
}

TEST(PolarTie, OfAMirroredElementKeepsTheRotationNearestToTheTie) {
  // The identity is the tie and one of the maximisers of tr(R^T diag(-1, 1, 1)), so it is the nearest one.
  EXPECT_LE((polar(kTied[0], Mat3::Identity()).R - Mat3::Identity()).norm(), 16 * kEps);
}

}  // namespace
}  // namespace orthodyn::polar_tie_test
