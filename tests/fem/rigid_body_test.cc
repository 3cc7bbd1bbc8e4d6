// Rigid regions: inertia, followers of the frame, supports, joints and messages.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "lib/ode/constraints.h"
#include "tests/fem/built_scene.h"

namespace orthodyn::rigid_body_test {
namespace {

// A rigid box and a soft one that shares no nodes with it.
std::string box_and_block(const std::string& more, const std::string& size = "[1, 0.4, 0.2]", double height = 2) {
  return fmt::format(R"(
mesh:
  type: bodies
  bodies:
    box: {{mesh: {{type: box, size: {}, cells: [3, 2, 2], order: 1}}}}
    block: {{mesh: {{type: box, size: [0.5, 0.4, 0.2], cells: [2, 1, 1], order: 1}}, translation: [0, 0, {}]}}
materials: {{m: {{type: isotropic, density: 50, young: 1e4, nu: 0.3}}}}
regions: {{box: {{material: m, rigid: true}}, block: {{material: m}}}}
time: {{end: 1}}
{}
)",
                     size, height, more);
}

std::string message(const std::string& more, double height = 2) {
  try {
    const BuiltTestScene s(box_and_block(more, "[0.5, 0.4, 0.2]", height));
    return "accepted";
  } catch (const ConfigError& e) {
    return e.what();
  }
}

// The block and twelve unknowns of the box, with six constraints.
TEST(RigidBodies, HaveTwelveUnknownsAndSixConstraints) {
  const BuiltTestScene s(box_and_block(""));
  const std::size_t block = 3 * 2 * 2;
  EXPECT_EQ(s.size(), static_cast<int>(3 * block) + 12);
  EXPECT_EQ(s.model().constraints()->size(), 6);
  EXPECT_EQ(s.model().parts().elastic.size(), 1u);
  EXPECT_EQ(s.model().constraints()->name(0), "rigid body box, distance");
}

// In a rigid motion, the kinetic energy equals that of a solid box with the exact inertia, also for thin boxes, and all
// nodes have the velocity of the motion.
TEST(RigidBodies, HaveTheExactInertia) {
  for (const Vec3& size : {Vec3(1, 0.4, 0.2), Vec3(1, 1, 0.01), Vec3(1, 0.02, 0.01)}) {
    const BuiltTestScene s(box_and_block("", fmt::format("[{}, {}, {}]", size[0], size[1], size[2])));
    const Vec3 velocity(1, 2, -3), spin(3, -5, 4), centre = size / 2;
    const double mass = 50 * size.prod();
    const Vec3 inertia = mass / 12 * (Vec3::Constant(size.squaredNorm()) - size.cwiseAbs2());
    State state = s.built.initial;
    state.v = s.dofs([&](const Vec3& X) -> Vec3 {
      return (X.array() <= size.array()).all() ? Vec3(velocity + spin.cross(X - centre)) : Vec3::Zero();
    });
    const double all = s.model().evaluate("energy.kinetic", state)[0];
    const NodalVector v = NodalExpansion(s.model().parts(), 0, state.q, state.v).u_rate;
    const double exact = 0.5 * mass * velocity.squaredNorm() + 0.5 * spin.dot(inertia.cwiseProduct(spin));
    EXPECT_NEAR(all, exact, 1e-12 * exact);
    for (std::size_t i = 0; i + 12 < s.mesh().nodes.size(); ++i)
      EXPECT_LE((v.col(static_cast<Eigen::Index>(i)) - velocity - spin.cross(s.mesh().nodes[i] - centre)).norm(),
                1e-11);
    Vector rates(6);
    s.model().constraints()->rates(0, state.q, state.v, rates);
    EXPECT_LE(rates.norm(), 1e-11);
  }
}

TEST(RigidBodies, ThinBodiesHaveIndependentConstraints) {
  for (const char* size : {"[1, 1, 0.001]", "[1, 0.001, 0.001]", "[1, 0.3, 0.001]"}) {
    const BuiltTestScene s(box_and_block("", size));
    const Eigen::MatrixXd G = s.model().constraints()->jacobian(0, s.zero());
    Eigen::MatrixXd scaled = G;
    for (Eigen::Index k = 0; k < G.cols(); ++k) scaled.col(k).normalize();
    const Vector values = scaled.jacobiSvd().singularValues();
    EXPECT_GE(values[5] / values[0], 1e-2) << size;
  }
}

TEST(RigidBodies, AreHeldByThreeNodes) {
  const BuiltTestScene s(box_and_block("clamps: [{surface: box.x0}]\noutput: {reactions: true}\ngravity: [0, 0, -10]"));
  EXPECT_EQ(s.model().constraints(), nullptr);
  EXPECT_EQ(s.size(), 3 * 12);
  const auto reaction = s.model().evaluate("reaction.clamp_1", s.built.initial);
  EXPECT_NEAR(reaction[2], 10 * 50 * 0.08, 1e-12 * 40);
  const auto torque = s.model().evaluate("torque.clamp_1", s.built.initial);  // about the middle of box.x0
  EXPECT_NEAR(torque[1], -10 * 50 * 0.08 * 0.5, 1e-12 * 40);
  EXPECT_THAT(message("clamps: [{nearest: [0, 0, 0]}]"), testing::HasSubstr("held in part"));
  EXPECT_THAT(message("clamps: [{surface: box.x0, components: [x]}]"), testing::HasSubstr("held in part"));
  EXPECT_THAT(
      message("clamps: [{surface: box.x0}]\nmotions: [{surface: box.x1, components: [x], translation: [1, 0, 0], "
              "factor: {type: smooth_step, end: 1}}]"),
      testing::HasSubstr("several clamps"));
}

TEST(RigidBodies, MoveWithThreeNodes) {
  const std::string motion =
      "motions: [{surface: box.x0, rotation: {axis: [0, 0, 1], angle: 90 deg}, factor: {type: "
      "smooth_step, end: 1}}]";
  const BuiltTestScene s(box_and_block(motion));
  const NodalExpansion nodal(s.model().parts(), 1, s.zero(), s.zero());
  for (std::size_t i = 0; i + 12 < s.mesh().nodes.size(); ++i) {
    const Vec3 X = s.mesh().nodes[i];
    EXPECT_LE((nodal.x.col(static_cast<Eigen::Index>(i)) - Vec3(-X[1], X[0], X[2])).norm(), 1e-14);
  }
  EXPECT_THAT(message("motions: [{surface: box.x0, displacement: [t, 0, 0]}]"), testing::HasSubstr("deform"));
}

// Regions that share nodes are one body; the bodies of `all` are separate.
TEST(RigidBodies, AreFormedByRegions) {
  const std::string beams = R"(
mesh:
  type: bodies
  bodies:
    a: {mesh: {type: box, size: [1, 1, 1], cells: [1, 1, 1], order: 1}}
    b: {mesh: {type: box, size: [1, 1, 1], cells: [1, 1, 1], order: 1}, translation: [1, 0, 0]}
materials: {m: {type: isotropic, density: 1, young: 1, nu: 0.3}}
regions: {all: {material: m, rigid: true}}
time: {end: 1}
)";
  const BuiltTestScene s(beams);
  EXPECT_EQ(s.model().parts().rigid_bodies.size(), 2u);
  EXPECT_EQ(s.size(), 24);
  EXPECT_EQ(s.model().constraints()->size(), 12);
}

TEST(RigidBodies, TakeTiesAsTheSecondSurface) {
  const BuiltTestScene s(box_and_block("ties: [{first: block.z0, second: box.z1}]", "[1, 0.4, 0.2]", 0.2));
  EXPECT_EQ(s.size(), 3 * 6 + 12);
  EXPECT_THAT(message("ties: [{first: box.z1, second: block.z0}]", 0.2), testing::HasSubstr("rigid region 'box'"));
}

// A joint of rigid bodies holds any point.
TEST(RigidBodies, HoldJointsAnywhere) {
  const BuiltTestScene s(
      box_and_block("joints: [{type: hinge, name: pin, from: [5, 5, 5], to: [5, 6, 5], first: {surface: box.x0}}]"));
  EXPECT_EQ(s.model().constraints()->size(), 5 + 6);
  EXPECT_THAT(message("joints: [{type: ball, name: pin, at: [5, 5, 5], first: {region: box}}, {type: hinge, name: "
                      "again, from: [5, 5, 5], to: [5, 6, 5], first: {region: box}}]"),
              testing::HasSubstr("already held"));
  EXPECT_THAT(message("joints: [{type: ball, name: pin, at: [0, 0, 0], first: {region: bx}}]"),
              testing::HasSubstr("'box'"));
}

TEST(RigidBodies, AreRefusedWhereTheyCannotBe) {
  EXPECT_THAT(message("mass: lumped"), testing::HasSubstr("inertia"));
  EXPECT_THAT(message("analysis: static"), testing::HasSubstr("is free"));
  EXPECT_THAT(message("start: equilibrium"), testing::HasSubstr("is free"));
  const BuiltTestScene held(box_and_block("analysis: static\nclamps: [{surface: box.x0}, {surface: block.x0}]"));
  EXPECT_EQ(held.size(), 3 * 8);
}

}  // namespace
}  // namespace orthodyn::rigid_body_test
