// Joints as constraints: points of bodies, derivatives, forces; and meshes of several bodies.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "lib/ode/constraints.h"
#include "tests/fem/built_scene.h"
#include "tests/fem/derivatives.h"

namespace orthodyn::joints_test {
namespace {

// Two bars, end to end at x = 1, of which the second one is turned about z.
std::string two_bars(const std::string& joints, const std::string& more = "") {
  return fmt::format(R"(
mesh:
  type: bodies
  bodies:
    upper: {{mesh: {{type: box, size: [1, 0.2, 0.2], cells: [2, 1, 1], order: 1}}}}
    lower: {{mesh: {{type: box, size: [1, 0.2, 0.2], cells: [2, 1, 1], order: 1}}, axis: [0, 0, 2], angle: 90 deg, translation: [1.3, 0, 0]}}
materials: {{m: {{type: orthotropic_stable, density: 1, young: [10, 1, 2], nu: 0.3}}}}
time: {{end: 1}}
joints: [{}]
{}
)",
                     joints, more);
}

const std::string kBall =
    "{type: ball, name: elbow, at: [1.05, 0.1, 0.1], first: {surface: upper.x1}, second: {surface: lower.x0}}";
const std::string kRod =
    "{type: distance, name: rod, from: [0.5, 0.1, 0.1], to: [1.2, 0.5, 0.1], first: {box: {min: [-1, -1, -1], max: "
    "[1.01, 1, 1]}}, "
    "second: {box: {min: [1.09, -1, -1], max: [2, 2, 2]}}}";

const std::string kAllNodes =
    "first: {box: {min: [-1, -1, -1], max: [1.01, 1, 1]}}, second: {box: {min: [1.09, -1, -1], max: [2, 2, 2]}}}";
const std::string kSlider = "{type: slider, name: rail, from: [0.5, 0.1, 0.1], to: [1.2, 0.5, 0.1], " + kAllNodes;
const std::string kCylindrical =
    "{type: cylindrical, name: rail, from: [0.5, 0.1, 0.1], to: [1.2, 0.5, 0.1], " + kAllNodes;

TEST(Bodies, ArePlacedAndNamed) {
  const BuiltTestScene s(two_bars(kRod));
  const Mesh& mesh = s.mesh();
  EXPECT_EQ(mesh.region_names, (std::vector<std::string>{"upper", "lower"}));
  ASSERT_TRUE(mesh.surfaces.contains("upper.x1") && mesh.surfaces.contains("lower.x0"));
  EXPECT_EQ(mesh.nodes.size(), 24u);
  Box lower{Vec3::Constant(9), Vec3::Constant(-9)};
  for (std::size_t i = 12; i < 24; ++i) {
    lower.min = lower.min.cwiseMin(mesh.nodes[i]);
    lower.max = lower.max.cwiseMax(mesh.nodes[i]);
  }
  EXPECT_LE((lower.min - Vec3(1.1, 0, 0)).norm(), 1e-15);
  EXPECT_LE((lower.max - Vec3(1.3, 1, 0.2)).norm(), 1e-15);
  for (const FaceCorners& face : mesh.surfaces.at("lower.x0"))
    for (const int corner : face) EXPECT_NEAR(mesh.node(corner)[1], 0, 1e-15);
}

TEST(JointPoints, FollowEveryAffineMotion) {
  const BuiltTestScene s(two_bars(kRod));
  std::vector<int> all, face;
  for (int i = 0; i < 12; ++i) {
    all.push_back(i);
    if (s.mesh().node(i)[0] == 1) face.push_back(i);
  }
  const Mat3 F = Random(440).matrix();
  for (const auto& [nodes, place] : {std::pair(all, Vec3(0.3, 0.5, -0.1)), std::pair(face, Vec3(1, 0.3, 0.05))}) {
    const JointPoint point = joint_point(s.mesh(), nodes, place);
    ASSERT_EQ(point.weights.size(), nodes.size());
    double sum = 0;
    Vec3 moved = Vec3::Zero();
    for (const auto& [node, weight] : point.weights) {
      sum += weight;
      moved += weight * (F * s.mesh().node(node) + Vec3(1, 2, 3));
    }
    EXPECT_NEAR(sum, 1, 1e-14);
    EXPECT_LE((moved - (F * place + Vec3(1, 2, 3))).norm(), 1e-13);
  }
  EXPECT_TRUE(joint_point(s.mesh(), face, Vec3(1.1, 0.1, 0.1)).weights.empty());  // beside the plane of the face
  EXPECT_TRUE(joint_point(s.mesh(), {0}, Vec3(0.1, 0, 0)).weights.empty());
  EXPECT_EQ(joint_point(s.mesh(), {0}, Vec3(0, 0, 0)).weights.size(), 1u);
}

struct Path {
  explicit Path(const BuiltTestScene& scene) : s(scene), constraints(*scene.model().constraints()) {
    Random random(51);
    q = random_dofs(random, s.size(), 0.05);
    v = random_dofs(random, s.size(), 1);
    a = random_dofs(random, s.size(), 1);
  }
  Vector at(double t) const { return q + t * v + t * t / 2 * a; }
  Vector rate(double t) const { return v + t * a; }
  const BuiltTestScene& s;
  const Constraints& constraints;
  Vector q, v, a;
};

class EachJoint : public testing::TestWithParam<std::string> {};
INSTANTIATE_TEST_SUITE_P(Joints, EachJoint, testing::Values(kRod, kSlider, kCylindrical));

TEST_P(EachJoint, HasItsDerivatives) {
  const BuiltTestScene s(two_bars(GetParam()));
  const Path path(s);
  const Constraints& constraints = path.constraints;
  const auto values = [&](double t) {
    Vector g(constraints.size());
    constraints.values(t, path.at(t), g);
    return g;
  };
  const auto rates = [&](double t) {
    Vector g(constraints.size());
    constraints.rates(t, path.at(t), path.rate(t), g);
    return g;
  };
  expect_derivative(values, rates(0));
  Vector c(constraints.size());
  constraints.curvature(0, path.q, path.v, c);
  const Eigen::SparseMatrix<double> G = constraints.jacobian(0, path.q);
  EXPECT_LE((G.transpose() * path.v - rates(0)).norm(), 1e-14);
  expect_derivative(rates, G.transpose() * path.a + c);
}

// The forces of a joint have no resultant and no torque about any point.
TEST_P(EachJoint, HasForcesThatCancel) {
  const BuiltTestScene s(two_bars(GetParam()));
  const Path path(s);
  const NodalVector x = s.positions(path.q);
  const NodalVector f =
      joint_forces(s.model().parts(), x - *s.model().parts().rest, Vector::Constant(path.constraints.size(), 2));
  EXPECT_GE(f.norm(), 0.1);
  EXPECT_LE(f.rowwise().sum().norm(), 1e-14);
  Vec3 torque = Vec3::Zero();
  for (Eigen::Index i = 0; i < f.cols(); ++i) torque += Vec3(x.col(i)).cross(Vec3(f.col(i)));
  EXPECT_LE(torque.norm(), 1e-14);
  Vector on_dofs(s.size());
  s.model().parts().dofs->restrict_to(f, on_dofs);
  EXPECT_LE((on_dofs + path.constraints.jacobian(0, path.q) * Vector::Constant(path.constraints.size(), 2)).norm(),
            1e-14);
}

TEST(Joints, StartWithVelocitiesThatFit) {
  const BuiltTestScene s(two_bars(kRod, "initial: {velocity_field: [y, -x, x*z]}"));
  const Constraints& constraints = *s.model().constraints();
  Vector rates(constraints.size());
  constraints.rates(0, s.built.initial.q, s.built.initial.v, rates);
  EXPECT_LE(rates.norm(), 1e-14);
  EXPECT_GE(s.built.initial.v.norm(), 1);
  Vector a = s.force(s.built.initial.q, s.built.initial.v), c(constraints.size());
  const Eigen::SparseMatrix<double> G = constraints.jacobian(0, s.built.initial.q);
  a -= G * s.built.initial.lambda;
  s.model().solve_mass(a);
  constraints.curvature(0, s.built.initial.q, s.built.initial.v, c);
  EXPECT_LE((G.transpose() * a + c).norm(), 1e-12);
}

TEST(Joints, AreRefusedWithTheReason) {
  const auto message = [](const std::string& joints, const std::string& more = "") {
    try {
      const BuiltTestScene s(two_bars(joints, more));
      return std::string("accepted");
    } catch (const ConfigError& e) {
      return std::string(e.what());
    }
  };
  using testing::HasSubstr;
  EXPECT_THAT(message(kBall), HasSubstr("cannot hold the point"));
  EXPECT_THAT(message("{type: ball, name: a, first: {surface: upper.x1}}"), HasSubstr("needs `at`"));
  EXPECT_THAT(message("{type: hinge, name: a, from: [1, 0, 0], first: {surface: upper.x1}}"), HasSubstr("`to`"));
  EXPECT_THAT(message("{type: slider, name: a, from: [1, 0, 0], first: {surface: upper.x1}}"), HasSubstr("slides"));
  EXPECT_THAT(message("{type: ball, name: a, at: [1, 0.1, 0.1], first: {surface: upper.x2}}"), HasSubstr("upper.x1"));
  const std::string pin = "at: [1, 0.1, 0.1], first: {surface: upper.x1}}";
  EXPECT_THAT(message("{type: ball, name: a, " + pin + ", {type: ball, name: b, " + pin), HasSubstr("already held"));
  EXPECT_THAT(message("{type: ball, name: a, " + pin, "clamps: [{surface: upper.x1}]"), HasSubstr("clamped"));
  EXPECT_THAT(message("{type: ball, name: a, " + pin, "initial: {displacement_field: [0.1, 0, 0]}"),
              HasSubstr("apart"));
  EXPECT_THAT(message("{type: ball, name: a, " + pin + ", {type: ball, name: b, " + pin), HasSubstr("joints."));
}

TEST(Joints, VelocitiesThatTheyForbidAreTold) {
  const std::string ball = "{type: ball, name: a, at: [1, 0.1, 0.1], first: {surface: upper.x1}}";
  const BuiltTestScene forbidden(two_bars(ball, "initial: {velocity: [1, 0, 0]}")), rest(two_bars(ball, ""));
  EXPECT_THAT(forbidden.built.warnings, testing::Contains(testing::HasSubstr("the joints forbid")));
  EXPECT_THAT(rest.built.warnings, testing::Not(testing::Contains(testing::HasSubstr("the joints forbid"))));
}

}  // namespace
}  // namespace orthodyn::joints_test
