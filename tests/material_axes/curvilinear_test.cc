// Cylindrical and spherical axes.
#include <fmt/format.h>

#include <numbers>

#include "tests/material_axes/axes_of.h"

namespace orthodyn::curvilinear_test {
namespace {

constexpr double kPi = std::numbers::pi;

std::string cylinder(const Vec3& point, const Vec3& axis, const std::string& more = "") {
  return fmt::format("{{type: cylindrical, point: {}, axis: {}{}}}", yaml_of(point), yaml_of(axis), more);
}
std::string sphere(const Vec3& center, const Vec3& pole, const std::string& more = "") {
  return fmt::format("{{type: spherical, center: {}, pole: {}{}}}", yaml_of(center), yaml_of(pole), more);
}

TEST(CylindricalAxes, AreRotationsThatDifferFromPlaceToPlace) {
  Random random(31);
  for (int sample = 0; sample < 100; ++sample) {
    const auto yaml = cylinder(random.vector(), random.vector(), ", spiral: 0.3 rad, order: TRL");
    EXPECT_LE(improper(axes_at(yaml, random.vector())), 1e-14);
    EXPECT_FALSE(axes_source(yaml)->uniform());
  }
}

TEST(CylindricalAxes, AreAlongAwayFromAndAroundTheAxis) {
  Random random(32);
  for (int sample = 0; sample < 50; ++sample) {
    const Vec3 point = random.vector(), L = random.vector().normalized(), x = random.vector();
    const Mat3 Q = axes_at(cylinder(point, 7 * L), x);
    EXPECT_LE((Q.col(0) - L).norm(), 1e-14);
    const Vec3 nearest = point + L * L.dot(x - point);
    EXPECT_LE((Q.col(1) - (x - nearest).normalized()).norm(), 1e-13);
    EXPECT_LE((Q.col(2) - L.cross(x - point).normalized()).norm(), 1e-13);
  }
}

TEST(CylindricalAxes, ByDefaultAreAboutZ) {
  EXPECT_LE((axes_at("{type: cylindrical}", {0, 2, 5}) - (Mat3() << 0, 0, -1, 0, 1, 0, 1, 0, 0).finished()).norm(),
            1e-15);
}

// At (2, 0, 0) about z: L = z, R = x, T = y. Axis 3 = 1 x 2 may be reversed.
TEST(CylindricalAxes, TakeTheOrderOfTheWord) {
  const auto direction = [](char letter) { return Vec3::Unit(letter == 'L' ? 2 : letter == 'R' ? 0 : 1); };
  for (const std::string order : {"LRT", "LTR", "RLT", "RTL", "TLR", "TRL"}) {
    const Mat3 Q = axes_at(cylinder({0, 0, 0}, {0, 0, 1}, ", order: " + order), {2, 0, 0});
    EXPECT_LE((Q.col(0) - direction(order[0])).norm(), 1e-15) << order;
    EXPECT_LE((Q.col(1) - direction(order[1])).norm(), 1e-15) << order;
    EXPECT_NEAR(std::abs(Q.col(2).dot(direction(order[2]))), 1, 1e-15) << order;
    EXPECT_LE(improper(Q), 1e-15) << order;
  }
}

TEST(CylindricalAxes, OfSpiralGrainFollowAHelix) {
  const double spiral = 0.2, radius = 3, pitch = 2 * kPi * radius / std::tan(spiral);
  // A right-handed helix about z: x = r cos a, y = r sin a, z = pitch a / 2 pi.
  for (const double a : {0.0, 1.0, 4.0}) {
    const Vec3 x(radius * std::cos(a), radius * std::sin(a), pitch * a / (2 * kPi));
    const Vec3 tangent = Vec3(-radius * std::sin(a), radius * std::cos(a), pitch / (2 * kPi)).normalized();
    const Mat3 Q = axes_at(cylinder({0, 0, 0}, {0, 0, 1}, fmt::format(", spiral: {} rad", spiral)), x);
    EXPECT_LE((Q.col(0) - tangent).norm(), 1e-14);
    EXPECT_LE((Q.col(1) - Vec3(std::cos(a), std::sin(a), 0)).norm(), 1e-14);
  }
}

TEST(CylindricalAxes, OnTheAxisAreTheDocumentedOnes) {
  EXPECT_LE((axes_at(cylinder({0, 0, 0}, {0, 0, 1}), {0, 0, 4}).col(1) - Vec3(1, 0, 0)).norm(), 1e-15);
  EXPECT_LE((axes_at(cylinder({0, 0, 0}, {2, 0, 0}), {4, 0, 0}).col(1) - Vec3(0, 1, 0)).norm(), 1e-15);
  // Off the axis by round-off: the same axes, not a direction from round-off.
  const Vec3 axis = Vec3(1, 2, 3).normalized();
  const Mat3 on = axes_at(cylinder({0.1, 0.2, 0.3}, axis), {0.1, 0.2, 0.3});
  for (const double along : {0.1, 1.0 / 3, 7.7})
    EXPECT_LE((axes_at(cylinder({0.1, 0.2, 0.3}, axis), Vec3(0.1, 0.2, 0.3) + along * axis) - on).norm(), 1e-15);
}

TEST(CylindricalAxes, OfNoDirectionAreRefused) {
  EXPECT_TRUE(holds(axes_refusal(cylinder({0, 0, 0}, {0, 0, 0})), "axes.axis: is zero"));
}

TEST(SphericalAxes, AreRadialEastAndNorth) {
  Random random(33);
  for (int sample = 0; sample < 50; ++sample) {
    const Vec3 center = random.vector(), pole = random.vector(), x = random.vector();
    const Mat3 Q = axes_at(sphere(center, pole), x);
    EXPECT_LE(improper(Q), 1e-14);
    EXPECT_LE((Q.col(0) - (x - center).normalized()).norm(), 1e-14);
    EXPECT_LE((Q.col(1) - pole.cross(x - center).normalized()).norm(), 1e-13);
    EXPECT_GT(Q.col(2).dot(pole), 0);
  }
}

TEST(SphericalAxes, TakeTheOrderOfTheWord) {
  // On the equator at x: R = x, E = y, N = z.
  const auto direction = [](char letter) { return Vec3::Unit(letter == 'R' ? 0 : letter == 'E' ? 1 : 2); };
  for (const std::string order : {"REN", "RNE", "ERN", "ENR", "NRE", "NER"}) {
    const Mat3 Q = axes_at(sphere({0, 0, 0}, {0, 0, 1}, ", order: " + order), {2, 0, 0});
    EXPECT_LE((Q.col(0) - direction(order[0])).norm(), 1e-15) << order;
    EXPECT_LE((Q.col(1) - direction(order[1])).norm(), 1e-15) << order;
  }
}

TEST(SphericalAxes, AtThePolesAndTheCentreAreTheDocumentedOnes) {
  const Mat3 pole = axes_at(sphere({0, 0, 0}, {0, 0, 1}), {0, 0, -2});
  EXPECT_LE(improper(pole), 1e-15);
  EXPECT_LE((pole.col(0) - Vec3(0, 0, -1)).norm(), 1e-15);
  EXPECT_LE((pole.col(2) - Vec3(1, 0, 0)).norm(), 1e-15);
  EXPECT_LE((axes_at(sphere({1, 2, 3}, {0, 0, 1}), {1, 2, 3}).col(0) - Vec3(0, 0, 1)).norm(), 1e-15);
}

}  // namespace
}  // namespace orthodyn::curvilinear_test
