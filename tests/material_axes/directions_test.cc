// Uniform axes: directions, a matrix, Euler angles, axis and angle.
#include <fmt/format.h>

#include <numbers>

#include "lib/material_axes/frame.h"
#include "lib/material_axes/given_axes.h"
#include "tests/material_axes/axes_of.h"

namespace orthodyn::directions_test {
namespace {

constexpr double kPi = std::numbers::pi;

TEST(Frame, IsARightHandedRotation) {
  Random random(17);
  for (int sample = 0; sample < 100; ++sample)
    EXPECT_LE(improper(frame(random.vector(), 5 * random.vector())), 16 * kEps);
}

TEST(Frame, PointsAlongItsFirstDirection) { EXPECT_EQ(frame({0, 0, 3}, {0, 1, 0}).col(0), Vec3(0, 0, 1)); }

TEST(Frame, TakesTheSecondWithoutItsPartAlongTheFirst) {
  EXPECT_EQ(frame({2, 0, 0}, {5, 3, 0}), Mat3(Mat3::Identity()));
}

TEST(Frame, OfNearlyParallelDirectionsIsStillOrthogonal) {
  EXPECT_LE(improper(frame({1, 1, 1}, {1, 1, 1 + 1e-5})), 16 * kEps);
}

TEST(Frame, DoesNotDependOnTheLengthsGiven) {
  const Vec3 a(1, 2, 3), b(-1, 0, 2);
  for (const double scale : {1e-200, 1e200})
    EXPECT_LE((frame(scale * a, b / scale) - frame(a, b)).cwiseAbs().maxCoeff(), 8 * kEps);
}

TEST(AnyNormal, IsAUnitVectorNormalToTheDirection) {
  Random random(18);
  for (int sample = 0; sample < 50; ++sample) {
    const Vec3 direction = random.vector(), normal = any_normal(direction);
    EXPECT_NEAR(normal.norm(), 1, 4 * kEps);
    EXPECT_NEAR(normal.dot(direction), 0, 4 * kEps);
  }
  EXPECT_EQ(any_normal({0, 0, 1}), Vec3(1, 0, 0));
  EXPECT_EQ(any_normal({1, 0, 0}), Vec3(0, 1, 0));
}

TEST(Directions, ByDefaultAreThoseOfSpace) { EXPECT_EQ(axes_at("{type: directions}"), Mat3(Mat3::Identity())); }

TEST(Directions, ThatAreParallelOrZeroAreRefused) {
  for (const char* text : {"first: [1, 2, 3], second: [-2, -4, -6]", "first: [0, 0, 0]", "first: [0, 1, 0]"})
    EXPECT_TRUE(holds(axes_refusal(fmt::format("{{type: directions, {}}}", text)), "zero or parallel"));
}

TEST(Directions, WithATypedThirdAreThoseThree) {
  const Mat3 Q = axes_at("{type: directions, first: [0, 0.866, 0.5], second: [0, -0.5, 0.866], third: [3, 0, 0]}");
  EXPECT_LE(improper(Q), 16 * kEps);
  EXPECT_NEAR(Q(2, 0), 0.5, 1e-4);
}

TEST(Directions, ThatAreNotOrthogonalAreRefusedWithTheAngle) {
  const auto text = axes_refusal("{type: directions, first: [1, 0, 0], second: [1, 1, 0], third: [0, 0, 1]}");
  EXPECT_TRUE(starts(text, "a.yaml:1:7: axes: "));
  EXPECT_TRUE(holds(text, "axes 1 and 2 enclose 45 degrees"));
  EXPECT_TRUE(holds(text, "'repair: orthonormalise'"));
}

TEST(Directions, ThatAreLeftHandedAreRefused) {
  const auto text = axes_refusal("{type: directions, third: [0, 0, -1]}");
  EXPECT_TRUE(holds(text, "left-handed"));
  EXPECT_FALSE(holds(text, "enclose"));
}

TEST(Directions, InOnePlaneAreRefusedEvenIfRepairIsAllowed) {
  EXPECT_TRUE(holds(axes_refusal("{type: directions, third: [1, 1, 0], repair: orthonormalise}"), "one plane"));
}

TEST(Directions, RefuseARepairOfNothing) {
  EXPECT_TRUE(holds(axes_refusal("{type: directions, repair: orthonormalise}"), "repair: is used with 'third' only"));
}

// Axes 1 and 2 enclose 90 - 2a degrees; the nearest rotation rotates both by a.
TEST(Repair, TurnsTwoDirectionsByTheSameAngle) {
  const double a = 0.1;
  const Vec3 first(std::cos(a), std::sin(a), 0), second(std::sin(a), std::cos(a), 0);
  const std::string yaml =
      fmt::format("{{type: directions, first: {}, second: {}, third: [0, 0, 1], repair: orthonormalise}}",
                  yaml_of(first), yaml_of(second));
  EXPECT_LE((axes_at(yaml) - Mat3::Identity()).cwiseAbs().maxCoeff(), 8 * kEps);
  ASSERT_EQ(notes_of(yaml).size(), 1u);
  EXPECT_TRUE(starts(notes_of(yaml)[0], "a.yaml:1:7: axes: "));
  EXPECT_TRUE(holds(notes_of(yaml)[0], fmt::format("rotated by at most {:.3g} degrees", a * 180 / kPi)));
}

TEST(Repair, ReversesTheThirdOfALeftHandedSetAndLeavesTheOthers) {
  const std::string yaml = "{type: matrix, matrix: [[1, 0, 0], [0, 1, 0], [0, 0, -1]], repair: orthonormalise}";
  EXPECT_EQ(axes_at(yaml), Mat3(Mat3::Identity()));
  EXPECT_TRUE(holds(notes_of(yaml)[0], "axis 3 reversed"));
}

TEST(Repair, OfAxesWithoutADefectSaysNothing) {
  EXPECT_TRUE(notes_of("{type: directions, third: [0, 0, 1], repair: orthonormalise}").empty());
}

TEST(Repair, GivesTheNearestOfAllRotations) {
  Random random(19);
  for (int sample = 0; sample < 20; ++sample) {
    Mat3 given = random.rotation() + 0.2 * random.matrix();
    for (int i = 0; i < 3; ++i) given.col(i).normalize();
    const Mat3 nearest = nearest_axes(given);
    EXPECT_LE(improper(nearest), 32 * kEps);
    for (int other = 0; other < 20; ++other) {
      const Mat3 turned = nearest * Eigen::AngleAxisd(random.between(-0.5, 0.5), random.vector().normalized());
      EXPECT_LE((nearest - given).norm(), (turned - given).norm() + 1e-12);
    }
  }
}

TEST(MatrixAxes, AreItsColumns) {
  EXPECT_LE((axes_at("{type: matrix, matrix: [[0, 0, 1], [1, 0, 0], [0, 1, 0]]}").col(0) - Vec3(0, 1, 0)).norm(),
            4 * kEps);
}

TEST(MatrixAxes, OfAnotherLengthAreRefusedWithIt) {
  EXPECT_TRUE(
      holds(axes_refusal("{type: matrix, matrix: [[1, 0, 0], [0, 2.5, 0], [0, 0, 1]]}"), "axis 2 has length 2.5"));
}

TEST(MatrixAxes, TypedWithThreeDigitsBecomeARotation) {
  EXPECT_LE(improper(axes_at("{type: matrix, matrix: [[0.866, -0.5, 0], [0.5, 0.866, 0], [0, 0, 1]]}")), 16 * kEps);
}

std::string euler(const Vec3& angles, const std::string& convention) {
  return fmt::format("{{type: euler, angles: [{} rad, {} rad, {} rad], convention: {}}}", angles[0], angles[1],
                     angles[2], convention);
}

Mat3 turn(int axis, double angle) { return Eigen::AngleAxisd(angle, Vec3::Unit(axis)).toRotationMatrix(); }

TEST(EulerAxes, TurnAboutTheAxesOfTheConventionOneAfterTheOther) {
  const Vec3 angles(0.3, -0.7, 1.1);
  for (const auto& convention : Registry<AxesSource>::entries().at("euler").keys[1].schema.names) {
    Mat3 Q = Mat3::Identity();  // each turn about an axis of the frame as it stands
    for (std::size_t i = 0; i < 3; ++i) {
      const Vec3 about = Q.col(convention[i] - 'x');
      Q = Eigen::AngleAxisd(angles[static_cast<Eigen::Index>(i)], about) * Q;
    }
    EXPECT_LE((axes_at(euler(angles, convention)) - Q).cwiseAbs().maxCoeff(), 8 * kEps) << convention;
  }
}

TEST(EulerAxes, ZyxIsYawPitchRoll) {
  const Mat3 Q = turn(2, 0.3) * turn(1, 0.2) * turn(0, 0.1);
  EXPECT_LE((axes_at(euler({0.3, 0.2, 0.1}, "zyx")) - Q).cwiseAbs().maxCoeff(), 8 * kEps);
}

TEST(EulerAxes, NeedAConventionByName) {
  EXPECT_TRUE(holds(axes_refusal("{type: euler, angles: [1 rad, 2 rad, 3 rad]}"), "'convention' is missing"));
  EXPECT_TRUE(
      holds(axes_refusal("{type: euler, angles: [1 rad, 2 rad, 3 rad], convention: zxx}"), "did you mean 'zxy'"));
}

TEST(AxisAngleAxes, TurnRightHandedAboutTheAxis) {
  const Mat3 Q = axes_at(fmt::format("{{type: axis_angle, axis: [0, 0, 5], angle: {} rad}}", kPi / 2));
  EXPECT_LE((Q.col(0) - Vec3(0, 1, 0)).norm(), 4 * kEps);
  EXPECT_LE((Q.col(1) - Vec3(-1, 0, 0)).norm(), 4 * kEps);
}

TEST(AxisAngleAxes, OfNoDirectionAreRefused) {
  EXPECT_TRUE(holds(axes_refusal("{type: axis_angle, axis: [0, 0, 0], angle: 1 rad}"), "axes.axis: is zero"));
}

TEST(AxesSource, OfAnUnknownKindIsRefusedWithTheKnownOnes) {
  EXPECT_TRUE(holds(axes_refusal("{type: cylindric}"), "did you mean 'cylindrical'"));
}

}  // namespace
}  // namespace orthodyn::directions_test
