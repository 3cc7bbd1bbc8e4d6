// Rigid regions: inertia, followers of the frame, supports, joints and messages.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <numeric>

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

// A rigid box that translates and spins has the kinetic energy of the exact moments of inertia, also if it is thin. All
// of its nodes have the velocity of this motion.
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

// Round-off does not choose among nodes that are equally far, so that runs are reproducible.
TEST(RigidBodies, HaveTheSameFrameInAnyPlace) {
  const Mesh at_rest = BuiltTestScene(box_and_block("")).mesh();
  std::vector<int> nodes(at_rest.nodes.size() - 12);  // of the box
  std::iota(nodes.begin(), nodes.end(), 0);
  const auto frame = rigid_body(at_rest, nodes, "box", "").frame;
  Random random(31);
  for (int k = 0; k < 20; ++k) {
    Mesh mesh = at_rest;
    const Mat3 R = random.rotation();
    const Vec3 shift = random.vector();
    for (Vec3& node : mesh.nodes) node = R * node + shift;
    EXPECT_EQ(rigid_body(mesh, nodes, "box", "").frame, frame);
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

// A rigid box of 4 kg, with two regions or with one.
const std::string kTip = ", parts: {tip: {min: [0.5, 0, 0], max: [1, 1, 1]}}";
std::string rigid_box(const std::string& regions, const std::string& more = "", const std::string& parts = kTip) {
  return fmt::format(R"(
mesh: {{type: box, size: [1, 0.4, 0.2], cells: [4, 2, 2], order: 1{}}}
materials: {{m: {{type: isotropic, density: 50, young: 1e4, nu: 0.3}}}}
regions: {}
time: {{end: 1}}
{}
)",
                     parts, regions, more);
}

// Half of the box, by its closed form.
std::string half(double x) {
  const double m = 2, xx = m / 12 * (0.16 + 0.04), yy = m / 12 * (0.25 + 0.04), zz = m / 12 * (0.25 + 0.16);
  return fmt::format(
      "{{material: m, rigid: {{mass: 2 kg, center: [{}, 0.2, 0.1], inertia: [{:.17g}, {:.17g}, {:.17g}]}}}}", x, xx, yy,
      zz);
}

// A body with the given inertia of its mesh has the mass matrix of a body that computes it from the mesh. The given
// inertias of two regions of one body add up.
TEST(GivenInertia, MayBeThatOfTheMesh) {
  const std::string by_mesh = "{material: m, rigid: true}";
  const BuiltTestScene mesh(rigid_box("{all: " + by_mesh + "}"));
  ASSERT_EQ(mesh.size(), 12);
  for (const auto& [body, tip] :
       {std::pair(half(0.25), half(0.75)), std::pair(by_mesh, half(0.75)), std::pair(half(0.25), by_mesh)}) {
    const BuiltTestScene s(rigid_box(fmt::format("{{body: {}, tip: {}}}", body, tip)));
    EXPECT_LE((s.mass() - mesh.mass()).norm(), 1e-13 * mesh.mass().norm());
    EXPECT_NEAR(s.model().parts().mass->total(), 4, 1e-14);
  }
}

// The inertia that `orthodyn check` prints, of a body by its mesh, by given inertias, and by both.
TEST(GivenInertia, IsToldForTheWholeBody) {
  const std::string by_mesh = "{material: m, rigid: true}";
  const Vec3 moments = 4.0 / 12 * Vec3(0.16 + 0.04, 1 + 0.04, 1 + 0.16);  // of the whole box, ascending
  for (const auto& [body, tip] : {std::pair(by_mesh, by_mesh), std::pair(half(0.25), half(0.75)),
                                  std::pair(by_mesh, half(0.75)), std::pair(half(0.25), by_mesh)}) {
    const BuiltTestScene s(rigid_box(fmt::format("{{body: {}, tip: {}}}", body, tip)));
    const RigidInertia& inertia = s.model().parts().rigid_bodies.at(0).inertia;
    EXPECT_NEAR(inertia.mass, 4, 1e-12);
    EXPECT_LE((inertia.center - Vec3(0.5, 0.2, 0.1)).norm(), 1e-12);
    EXPECT_LE((inertia.principal_moments() - moments).norm(), 1e-12);
  }
}

struct Given {
  double mass = 3;
  Vec3 center{2, -1, 0.5};
  Mat3 moments;
  std::string region;

  Given() {
    const Mat3 axes = Random(12).rotation();
    moments = axes * Vec3(0.5, 0.9, 1.3).asDiagonal() * axes.transpose();
    region = fmt::format(
        "{{material: m, rigid: {{mass: 3 kg, center: [2, -1, 0.5], inertia: [{:.17g}, {:.17g}, {:.17g}, {:.17g}, "
        "{:.17g}, {:.17g}]}}}}",
        moments(0, 0), moments(1, 1), moments(2, 2), moments(0, 1), moments(1, 2), moments(2, 0));
  }
};

// Energies and momenta of any rigid motion.
TEST(GivenInertia, IsExact) {
  const Given given;
  const Vec3 velocity(1, 2, -3), spin(3, -5, 4), shift(0.3, 0.2, -0.7), g(1, 2, -10);
  const BuiltTestScene s(rigid_box("{all: " + given.region + "}", "gravity: [1, 2, -10]", ""));
  const Mat3 R = Random(13).rotation();
  State state = s.built.initial;
  state.q = s.dofs([&](const Vec3& X) -> Vec3 { return R * (X - given.center) + given.center + shift - X; });
  state.v = s.dofs([&](const Vec3& X) -> Vec3 { return velocity + spin.cross(R * (X - given.center)); });
  const auto vector = [&](const char* name) {
    const auto x = s.model().evaluate(name, state);
    return Vec3(x[0], x[1], x[2]);
  };
  const Vec3 L = R * given.moments * R.transpose() * spin;  // about the centre
  const double kinetic = 0.5 * given.mass * velocity.squaredNorm() + 0.5 * spin.dot(L);
  EXPECT_NEAR(s.model().evaluate("energy.kinetic", state)[0], kinetic, 1e-12 * kinetic);
  EXPECT_NEAR(s.model().evaluate("energy.gravitational", state)[0], -given.mass * g.dot(shift), 1e-12 * 3 * 10);
  EXPECT_LE((vector("momentum.linear") - given.mass * velocity).norm(), 1e-12 * 3 * 4);
  const Vec3 angular = L + given.mass * (given.center + shift).cross(velocity);
  EXPECT_LE((vector("momentum.angular") - angular).norm(), 1e-12 * angular.norm());
  EXPECT_NEAR(s.model().parts().mass->total(), given.mass, 1e-12);
}

// Gravity and the inertia of a motion act at the centre.
TEST(GivenInertia, IsThatOfReactions) {
  const Given given;
  const auto expect_reaction = [&](const std::string& support, const std::string& name) {
    const BuiltTestScene s(fmt::format(R"(
mesh:
  type: bodies
  bodies:
    box: {{mesh: {{type: box, size: [1, 0.4, 0.2], cells: [1, 1, 1], order: 1}}}}
    free: {{mesh: {{type: box, size: [1, 1, 1], cells: [1, 1, 1], order: 1}}, translation: [0, 0, 5]}}
materials: {{m: {{type: isotropic, density: 50, young: 1e4, nu: 0.3}}}}
regions: {{box: {}, free: {{material: m}}}}
{}
output: {{reactions: true}}
time: {{end: 1}}
)",
                                       given.region, support));
    const auto force = s.model().evaluate("reaction." + name, s.built.initial);
    const auto torque = s.model().evaluate("torque." + name, s.built.initial);
    const Vec3 weight(0, 0, -10 * given.mass), arm = given.center - Vec3(0, 0.2, 0.1);  // from the middle of box.x0
    EXPECT_LE((Vec3(force[0], force[1], force[2]) + weight).norm(), 1e-12 * weight.norm());
    EXPECT_LE((Vec3(torque[0], torque[1], torque[2]) + arm.cross(weight)).norm(), 1e-12 * arm.cross(weight).norm());
  };
  expect_reaction("clamps: [{surface: box.x0}]\ngravity: [0, 0, -10]", "clamp_1");
  expect_reaction("motions: [{surface: box.x0, translation: [0, 0, 5], factor: {type: expression, formula: 't^2'}}]",
                  "motion_1");
}

TEST(GivenInertia, MustBeThatOfABody) {
  const auto message = [](const std::string& rigid, const std::string& more = "") {
    try {
      const BuiltTestScene s(rigid_box("{all: {material: m, rigid: " + rigid + "}}", more));
      return std::string("accepted");
    } catch (const ConfigError& e) {
      return std::string(e.what());
    }
  };
  const auto with = [](const std::string& inertia) { return "{mass: 1, center: [0, 0, 0], inertia: " + inertia + "}"; };
  using testing::HasSubstr;
  EXPECT_THAT(message(with("[1, 1, 1]")), HasSubstr("stands for 2 regions"));
  EXPECT_THAT(message(with("[1, 2, 3.1]")), HasSubstr("1, 2 and 3.1 kg m^2, which no body has"));
  EXPECT_THAT(message(with("[1, 2, 3]")), HasSubstr("without thickness"));
  EXPECT_THAT(message(with("[1, 2, 2.999]")), HasSubstr("stands for"));
  EXPECT_THAT(message(with("[1, 1, 1, 2, 0, 0]")), HasSubstr("which no body has"));
  EXPECT_THAT(message(with("[-1, 1, 1]")), HasSubstr("must be positive"));
  EXPECT_THAT(message(with("[0, 0, 0]")), HasSubstr("must be positive"));
  EXPECT_THAT(message(with("[1, 1]")), HasSubstr("3 moments"));
  EXPECT_THAT(message("{mass: -1, center: [0, 0, 0], inertia: [1, 1, 1]}"), HasSubstr("rigid.mass: must be > 0"));
  EXPECT_THAT(message("{mass: 1, inertia: [1, 1, 1]}"), HasSubstr("'center' is missing"));
  EXPECT_THAT(message("{mass: 1, centre: [0, 0, 0], inertia: [1, 1, 1]}"), HasSubstr("center"));
  EXPECT_THAT(message(with("[1, 1, 1]"), "mass: lumped"), HasSubstr("lumped"));
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
              testing::HasSubstr("already held by the joint again in the rest shape, 3 constraints too many"));
  const std::string turned =
      "joints: [{type: hinge, name: pin, from: [0, 0, 0], to: [0, 1, 0], first: {region: box}, motor: "
      "{to: 1 rad, factor: {type: expression, formula: 't'}}}, {type: distance, name: rod, from: "
      "[1, 0, 0], to: [1, 0, -3], first: {region: box}}]";
  EXPECT_THAT(message(turned), testing::HasSubstr("contradicts the joint"));
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
