#include "lib/material/axes.h"

#include <gtest/gtest.h>

#include "tests/core/messages.h"
#include "tests/material/constants.h"

namespace orthodyn {
namespace {

TEST(Axes, AreARightHandedRotation) {
  Random random(17);
  for (int sample = 0; sample < 100; ++sample) {
    const Mat3 Q = Axes{random.vector(), 5 * random.vector()}.rotation();
    EXPECT_LE((Q.transpose() * Q - Mat3::Identity()).cwiseAbs().maxCoeff(), 8 * kEps);
    EXPECT_NEAR(Q.determinant(), 1, 8 * kEps);
  }
}

TEST(Axes, TheFirstPointsAlongItsDirection) {
  EXPECT_EQ((Axes{{0, 0, 3}, {0, 1, 0}}.rotation().col(0)), Vec3(0, 0, 1));
}

TEST(Axes, TheSecondLosesItsPartAlongTheFirst) {
  EXPECT_EQ((Axes{{2, 0, 0}, {5, 3, 0}}.rotation()), Mat3(Mat3::Identity()));
}

TEST(Axes, OfNearlyParallelDirectionsAreStillOrthogonal) {
  const Mat3 Q = Axes{{1, 1, 1}, {1, 1, 1 + 1e-5}}.rotation();
  EXPECT_LE((Q.transpose() * Q - Mat3::Identity()).cwiseAbs().maxCoeff(), 8 * kEps);
}

TEST(Axes, DoNotDependOnTheLengthsGiven) {
  const Vec3 a(1, 2, 3), b(-1, 0, 2);
  const Mat3 Q = Axes{a, b}.rotation();
  for (const double scale : {1e-200, 1e200})
    EXPECT_LE(((Axes{scale * a, b / scale}.rotation()) - Q).cwiseAbs().maxCoeff(), 8 * kEps);
}

std::string refusal_of(const std::string& axes) {
  return refusal([&] { Axes::spec().read(Config::from_text(axes, "a.yaml")); });
}

TEST(Axes, ThatAreParallelOrZeroAreRefused) {
  EXPECT_TRUE(holds(refusal_of("{first: [1, 2, 3], second: [-2, -4, -6]}"), "zero or parallel"));
  EXPECT_TRUE(holds(refusal_of("{first: [0, 0, 0]}"), "zero or parallel"));
  EXPECT_TRUE(holds(refusal_of("{first: [0, 1, 0]}"), "zero or parallel"));
}

TEST(Axes, ByDefaultAreThoseOfSpace) {
  EXPECT_EQ(Axes::spec().read(Config::from_text("{}")).rotation(), Mat3(Mat3::Identity()));
}

}  // namespace
}  // namespace orthodyn
