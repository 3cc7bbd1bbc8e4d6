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

const std::string kMotor = "{to: 0.7, factor: {type: expression, formula: 'sin(3*t)'}}";
const std::string kDrivenSlider =
    "{type: slider, name: rail, from: [0.5, 0.1, 0.1], to: [1.2, 0.5, 0.1], motor: " + kMotor + ", " + kAllNodes;
const std::string kDrivenHinge =
    "{type: hinge, name: rail, from: [0.5, 0.1, 0.1], to: [1.2, 0.5, 0.1], motor: " + kMotor + ", " + kAllNodes;
const std::string kDrivenCylindrical =
    "{type: cylindrical, along: turn, name: rail, from: [0.5, 0.1, 0.1], to: [1.2, 0.5, 0.1], motor: " + kMotor + ", " +
    kAllNodes;
const std::string kDrivenRod =
    "{type: distance, name: rod, from: [0.5, 0.1, 0.1], to: [1.2, 0.5, 0.1], motor: " + kMotor + ", " + kAllNodes;
const std::string kForces =
    "spring: {stiffness: 3, damping: 0.2, rest: 0.1}, stop: {low: -0.01, high: 0.02, onset: 0.5, stiffness: 8}, "
    "friction: {limit: 0.5, creep: 0.3}";

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
  explicit Path(const BuiltTestScene& scene) : s(scene) {
    Random random(51);
    q = random_dofs(random, s.size(), 0.05);
    v = random_dofs(random, s.size(), 1);
    a = random_dofs(random, s.size(), 1);
  }
  Vector at(double t) const { return q + t * v + t * t / 2 * a; }
  Vector rate(double t) const { return v + t * a; }
  const Constraints& constraints() const { return *s.model().constraints(); }
  const BuiltTestScene& s;
  Vector q, v, a;
};

class EachJoint : public testing::TestWithParam<std::string> {};
INSTANTIATE_TEST_SUITE_P(Joints, EachJoint,
                         testing::Values(kRod, kSlider, kCylindrical, kDrivenSlider, kDrivenHinge, kDrivenCylindrical,
                                         kDrivenRod));

TEST_P(EachJoint, HasItsDerivatives) {
  constexpr double kTime = 0.4;
  const BuiltTestScene s(two_bars(GetParam()));
  const Path path(s);
  const Constraints& constraints = path.constraints();
  const auto values = [&](double t) {
    Vector g(constraints.size());
    constraints.values(kTime + t, path.at(t), g);
    return g;
  };
  const auto rates = [&](double t) {
    Vector g(constraints.size());
    constraints.rates(kTime + t, path.at(t), path.rate(t), g);
    return g;
  };
  expect_derivative(values, rates(0));
  Vector c(constraints.size()), of_time(constraints.size());
  constraints.curvature(kTime, path.q, path.v, c);
  const Eigen::SparseMatrix<double> G = constraints.jacobian(kTime, path.q);
  constraints.rates(kTime, path.q, s.zero(), of_time);
  EXPECT_LE((G.transpose() * path.v + of_time - rates(0)).norm(), 1e-14);
  EXPECT_EQ(of_time.norm() > 0, s.model().parts().joints[0].motor() != nullptr);
  expect_derivative(rates, G.transpose() * path.a + c);
}

void expect_no_resultant(const NodalVector& x, const NodalVector& f) {
  EXPECT_GE(f.norm(), 0.01);
  EXPECT_LE(f.rowwise().sum().norm(), 1e-13);
  Vec3 torque = Vec3::Zero();
  for (Eigen::Index i = 0; i < f.cols(); ++i) torque += Vec3(x.col(i)).cross(Vec3(f.col(i)));
  EXPECT_LE(torque.norm(), 1e-13);
}

// The forces of a joint have no resultant and no torque about any point. The forces of two joined points have no torque
// only while the points coincide, so that a hinge is tested without them.
TEST_P(EachJoint, HasForcesThatCancel) {
  const BuiltTestScene s(two_bars(GetParam()));
  const Path path(s);
  Vector lambda = Vector::Constant(path.constraints().size(), 2);
  if (GetParam() == kDrivenHinge) lambda.head(6).setZero();
  const NodalExpansion nodal(s.model().parts(), 0.4, path.q, path.v);
  const NodalVector f = joint_forces(s.model().parts(), nodal, lambda);
  expect_no_resultant(nodal.x, f);
  Vector on_dofs(s.size());
  s.model().parts().dofs->restrict_to(f, on_dofs);
  EXPECT_LE((on_dofs + path.constraints().jacobian(0.4, path.q) * lambda).norm(), 1e-13);
}

// Springs, stops and friction along the coordinate.
class JointForces : public testing::TestWithParam<std::string> {
 protected:
  BuiltTestScene s{two_bars(fmt::format("{{type: {}, name: rail, from: [0.5, 0.1, 0.1], to: [1.2, 0.5, 0.1], {}, {}",
                                        GetParam(), kForces, kAllNodes))};
  const Term& term = *s.model().parts().loads.back();
  Path path{s};

  Vector force(double t, bool moving) const {
    const NodalExpansion nodal(s.model().parts(), 0, path.at(t), moving ? path.rate(t) : s.zero());
    NodalVector f = NodalVector::Zero(3, nodal.u.cols());
    term.add_force(nodal.state(), f);
    Vector out(s.size());
    s.model().parts().dofs->restrict_forces_to(f, out);
    return out;
  }
};
INSTANTIATE_TEST_SUITE_P(Types, JointForces,
                         testing::Values("hinge", "slider", "cylindrical", "cylindrical, along: turn", "strut"));

TEST_P(JointForces, AreTheGradientOfTheirEnergy) {
  const auto energy = [&](double t) {
    return one(term.energy(NodalExpansion(s.model().parts(), 0, path.at(t), s.zero()).state()));
  };
  EXPECT_GE(energy(0)[0], 1e-3);
  expect_derivative(energy, one(-force(0, false).dot(path.v)));
}

TEST_P(JointForces, HaveTheirTangent) {
  const auto tangent = [&](bool of_velocity) {
    std::vector<double> K(s.model().pattern().row.size(), 0), D(K.size(), 0);
    const NodalExpansion nodal(s.model().parts(), 0, path.q, of_velocity ? path.v : s.zero());
    term.add_tangent(nodal.state(), TangentKind::exact, K.data(), D.data());
    Vector out(s.size());
    s.model().pattern().multiply((of_velocity ? D : K).data(), of_velocity ? path.a : path.v, out);
    return out;
  };
  expect_derivative([&](double t) { return force(t, false); }, -tangent(false));
  const auto by_velocity = [&](double t) {
    Vector f(s.size());
    const NodalExpansion nodal(s.model().parts(), 0, path.q, path.rate(t));
    NodalVector all = NodalVector::Zero(3, nodal.u.cols());
    term.add_force(nodal.state(), all);
    s.model().parts().dofs->restrict_forces_to(all, f);
    return f;
  };
  expect_derivative(by_velocity, -tangent(true));
}

TEST_P(JointForces, CancelAndDissipate) {
  const NodalExpansion nodal(s.model().parts(), 0, path.q, path.v);
  NodalVector f = NodalVector::Zero(3, nodal.u.cols());
  term.add_force(nodal.state(), f);
  expect_no_resultant(nodal.x, f);
  const double power = (force(0, true) - force(0, false)).dot(path.v);
  EXPECT_GE(-power, 1e-3);
  EXPECT_NEAR(term.dissipation(nodal.state()), -power, 1e-13);
}

// A load along the coordinate.
class JointLoads : public testing::TestWithParam<std::string> {
 protected:
  static constexpr double kTime = 0.4;
  BuiltTestScene s{
      two_bars(fmt::format("{{type: {}, name: rail, from: [0.5, 0.1, 0.1], to: [1.2, 0.5, 0.1], load: {{amount: 3, "
                           "factor: {{type: expression, formula: 'sin(3*t)'}}}}, {}",
                           GetParam(), kAllNodes))};
  const Term& term = *s.model().parts().loads.back();
  const double size = 3 * std::sin(3 * kTime);  // N or N m
  Path path{s};

  NodalExpansion nodal(double t) const { return {s.model().parts(), kTime, path.at(t), path.rate(t)}; }
  Vector force(double t) const {
    NodalVector f = NodalVector::Zero(3, nodal(t).u.cols());
    term.add_force(nodal(t).state(), f);
    Vector out(s.size());
    s.model().parts().dofs->restrict_forces_to(f, out);
    return out;
  }
};
INSTANTIATE_TEST_SUITE_P(Types, JointLoads,
                         testing::Values("hinge", "slot", "cylindrical", "cylindrical, along: turn", "slider",
                                         "strut"));

// The force is the gradient of its amount times the coordinate, and its power the amount times the rate.
TEST_P(JointLoads, ActAlongTheCoordinate) {
  const JointCoordinate& coordinate = *s.model().parts().joints[0].coordinate;
  expect_derivative([&](double t) { return one(size * coordinate.value(nodal(t).u)); }, one(force(0).dot(path.v)));
  const NodalExpansion now = nodal(0);
  EXPECT_NEAR(term.load_power(now.state()), force(0).dot(path.v), 1e-12 * std::abs(size));
  EXPECT_NEAR(term.load_power(now.state()), size * coordinate.rate(now.u, now.u_rate), 1e-13 * std::abs(size));
  EXPECT_EQ(term.dissipation(now.state()), 0);
}

TEST_P(JointLoads, HaveTheirTangent) {
  std::vector<double> K(s.model().pattern().row.size(), 0);
  term.add_tangent(nodal(0).state(), TangentKind::exact, K.data(), nullptr);
  Vector change(s.size());
  s.model().pattern().multiply(K.data(), path.v, change);
  expect_derivative([&](double t) { return force(t); }, -change);
}

TEST_P(JointLoads, Cancel) {
  const NodalExpansion now = nodal(0);
  NodalVector f = NodalVector::Zero(3, now.u.cols());
  term.add_force(now.state(), f);
  expect_no_resultant(now.x, f);
}

// The coordinate of a hinge is the angle of the rotation about its line, by the right-hand rule; the coordinate of a
// slider is the distance along its line.
TEST(JointCoordinates, MeasureAngleAndDistance) {
  for (const double value : {0.3, -2.9}) {
    const Vec3 from(0.5, 0.1, 0.1), line = Vec3(0.7, 0.4, 0).normalized();
    const Mat3 R = Eigen::AngleAxisd(value, line).toRotationMatrix();
    const auto moved = [&](const char* type, auto&& u) {
      const BuiltTestScene s(two_bars(
          fmt::format("{{type: {}, name: rail, from: [0.5, 0.1, 0.1], to: [1.2, 0.5, 0.1], {}", type, kAllNodes)));
      State state = s.built.initial;
      state.q = s.dofs([&](const Vec3& X) -> Vec3 { return X[0] < 1.05 ? u(X) : Vec3::Zero(); });
      return s.model().evaluate("coordinate.rail", state)[0];
    };
    EXPECT_NEAR(moved("hinge", [&](const Vec3& X) -> Vec3 { return R * (X - from) + from - X; }), value, 1e-13);
    EXPECT_NEAR(moved("slider", [&](const Vec3&) -> Vec3 { return value * line; }), value, 1e-13);
  }
}

// A body that moves along a line by 0.2 m while it turns about it by 1.2 rad.
TEST(JointCoordinates, OfACylindricalJointAreBothMeasured) {
  const Vec3 from(0.5, 0.1, 0.1), line = Vec3(0.7, 0.4, 0).normalized();
  const Mat3 R = Eigen::AngleAxisd(1.2, line).toRotationMatrix();
  for (const auto& [along, coordinate] : {std::pair("slide", 0.2), std::pair("turn", 1.2)}) {
    const BuiltTestScene s(
        two_bars(fmt::format("{{type: cylindrical, along: {}, name: rail, from: [0.5, 0.1, 0.1], to: [1.2, 0.5, 0.1], "
                             "{}",
                             along, kAllNodes)));
    State state = s.built.initial;
    state.q = s.dofs([&](const Vec3& X) -> Vec3 {
      return X[0] < 1.05 ? Vec3(R * (X - from) + from - X + 0.2 * line) : Vec3::Zero();
    });
    const auto value = [&](const char* name) { return s.model().evaluate(name, state)[0]; };
    EXPECT_NEAR(value("slide.rail"), 0.2, 1e-13) << along;
    EXPECT_NEAR(value("angle.rail"), 1.2, 1e-13) << along;
    EXPECT_NEAR(value("coordinate.rail"), coordinate, 1e-13) << along;
  }
}

// Nodes on the line hold points of the line only: such a body slides, and its angle is not known.
TEST(JointCoordinates, NeedAPointBesideTheLineForAnAngle) {
  const auto joint = [](const std::string& along) {
    return "{type: cylindrical, name: rail, from: [0, 0, 0], to: [0.5, 0, 0], along: " + along +
           ", first: {box: {min: [-0.1, -0.1, -0.1], max: [1.01, 0.1, 0.1]}}}";
  };
  const BuiltTestScene s(two_bars(joint("slide")));
  EXPECT_TRUE(s.model().parts().joints[0].slide);
  EXPECT_FALSE(s.model().parts().joints[0].angle);
  try {
    const BuiltTestScene turning(two_bars(joint("turn")));
    ADD_FAILURE() << "accepted";
  } catch (const ConfigError& e) {
    EXPECT_THAT(e.what(), testing::HasSubstr("cannot hold the point"));
  }
}

// Both bodies turn and move. A strut holds nothing.
TEST(JointCoordinates, OfAStrutAreTheChangeOfItsDistance) {
  const Vec3 from(0.5, 0.1, 0.1), to(1.2, 0.5, 0.1);
  const Mat3 R = Eigen::AngleAxisd(0.4, Vec3(1, 2, 3).normalized()).toRotationMatrix();
  const auto first = [&](const Vec3& X) -> Vec3 { return R * X + Vec3(0.1, -0.3, 0.2); };
  const auto second = [&](const Vec3& X) -> Vec3 { return R.transpose() * X + Vec3(-0.2, 0.5, 0.1); };
  const BuiltTestScene s(
      two_bars("{type: strut, name: leg, from: [0.5, 0.1, 0.1], to: [1.2, 0.5, 0.1], load: {amount: 1}, " + kAllNodes));
  EXPECT_EQ(s.model().constraints(), nullptr);
  State state = s.built.initial;
  state.q = s.dofs([&](const Vec3& X) -> Vec3 { return (X[0] < 1.05 ? first(X) : second(X)) - X; });
  EXPECT_NEAR(s.model().evaluate("coordinate.leg", state)[0], (first(from) - second(to)).norm() - (from - to).norm(),
              1e-13);
}

TEST(JointCoordinates, OfAStrutHaveNoDerivativesWhereItsPointsMeet) {
  const BuiltTestScene s(
      two_bars("{type: strut, name: leg, from: [0.5, 0.1, 0.1], to: [1.2, 0.5, 0.1], load: {amount: 1}, " + kAllNodes));
  const Vector q = s.dofs([](const Vec3& X) -> Vec3 { return X[0] < 1.05 ? Vec3(0.7, 0.4, 0) : Vec3::Zero(); });
  NodalVector u = s.nodal(q);
  const JointCoordinate& coordinate = *s.model().parts().joints[0].coordinate;
  EXPECT_NEAR(coordinate.value(u), -std::hypot(0.7, 0.4), 1e-7);
  const JointPoint a{{{0, 1.0}}, Vec3(0, 0, 0)}, b{{{1, 1.0}}, Vec3(1, 0, 0)};
  u.col(0) = Vec3(1, 0, 0), u.col(1).setZero();
  EXPECT_THROW(JointCoordinate::stretching(a, b).expand(u), RecoverableError);
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

// The nodes of an oblique plane hold points of this plane only.
TEST(Joints, OfNodesInAnObliquePlaneHaveAnAngle) {
  const BuiltTestScene s(R"(
mesh: {type: box, size: [1, 0.2, 0.2], cells: [2, 1, 1], order: 1}
materials: {m: {type: isotropic, density: 1, young: 10, nu: 0.3}}
time: {end: 1}
joints:
  - {type: hinge, name: a, from: [0, 0.1, 0.1], to: [1, 0.1, 0.1], first: {plane: {point: [0, 0, 0], normal: [0, 1, -1]}}}
)");
  const Joint& joint = s.model().parts().joints.at(0);
  ASSERT_TRUE(joint.coordinate);
  const Vec3 from(0, 0.1, 0.1);
  const Mat3 R = Eigen::AngleAxisd(-0.2, Vec3::UnitX()).toRotationMatrix();
  const Vector q = s.dofs([&](const Vec3& x) { return Vec3(R * (x - from) + from - x); });
  const NodalExpansion nodal(s.model().parts(), 0, q, s.zero());
  EXPECT_NEAR(joint.coordinate->value(nodal.u), -0.2, 1e-12);
}

// A hinge has an angle if its first body holds a point beside the line.
TEST(Joints, OfNodesInAPlaneHaveAnAngle) {
  const BuiltTestScene s(
      two_bars("{type: hinge, name: a, from: [1, 0, 0.1], to: [1, 0.2, 0.1], first: {surface: "
               "upper.x1}}, {type: hinge, name: b, from: [0.2, 0, 0.2], to: [0.2, 0.2, 0.2], first: "
               "{surface: upper.z1}}"));
  for (const Joint& joint : s.model().parts().joints) {
    ASSERT_TRUE(joint.coordinate) << joint.name;
    // The bar turns about the y axis by 0.1 rad.
    const Vec3 from = joint.name == "a" ? Vec3(1, 0, 0.1) : Vec3(0.2, 0, 0.2);
    const Mat3 R = Eigen::AngleAxisd(0.1, Vec3::UnitY()).toRotationMatrix();
    const Vector q = s.dofs([&](const Vec3& x) { return Vec3(R * (x - from) + from - x); });
    const NodalExpansion nodal(s.model().parts(), 0, q, s.zero());
    EXPECT_NEAR(joint.coordinate->value(nodal.u), 0.1, 1e-12) << joint.name;
  }
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
  EXPECT_THAT(message("{type: ball, name: a, friction: {limit: 1}, " + pin), HasSubstr("hinge, slot"));
  const std::string rail = "{type: slot, name: a, from: [0.5, 0.1, 0.1], to: [1.2, 0.5, 0.1], ";
  EXPECT_THAT(message(rail + "stop: {high: 1 deg, stiffness: 1}, " + kAllNodes), HasSubstr("deg"));
  EXPECT_THAT(message(rail + "stop: {low: 0.1, stiffness: 1}, " + kAllNodes), HasSubstr("rest shape"));
  EXPECT_THAT(message(rail + "motor: {to: 1, factor: {type: constant}}, " + kAllNodes), HasSubstr("at the start"));
  const std::string pivot = "{type: hinge, name: a, from: [0.5, 0.1, 0.1], to: [1.2, 0.5, 0.1], ";
  EXPECT_THAT(message(pivot + "motor: {to: 180 deg, factor: {type: constant}}, " + kAllNodes),
              HasSubstr("at the start"));
  EXPECT_THAT(message(pivot + "stop: {high: 270 deg, stiffness: 1}, " + kAllNodes), HasSubstr("180 deg"));
  EXPECT_THAT(message("{type: ball, name: 'a, b', " + pin), HasSubstr("commas"));
  EXPECT_THAT(message(rail + "stop: {stiffness: 1}, " + kAllNodes), HasSubstr("low"));
  EXPECT_THAT(message(rail + "motor: " + kMotor + ", spring: {stiffness: 1}, " + kAllNodes), HasSubstr("prescribes"));
  EXPECT_THAT(message(rail + "motor: {to: 1, factor: {type: ramp, end: 1}}, " + kAllNodes), HasSubstr("smooth_step"));
  EXPECT_THAT(message("{type: ball, name: a, load: {amount: 1}, " + pin), HasSubstr("hinge, slot"));
  EXPECT_THAT(message(rail + "load: {amount: 1 N m}, " + kAllNodes), HasSubstr("load.amount: expected a force"));
  EXPECT_THAT(message(pivot + "load: {amount: 1 N}, " + kAllNodes), HasSubstr("load.amount"));
  EXPECT_THAT(message(rail + "load: {amount: 1, factor: {type: harmonic}}, " + kAllNodes), HasSubstr("harmonic"));
  const std::string ends = "name: a, from: [0.5, 0.1, 0.1], to: [1.2, 0.5, 0.1], ";
  const std::string rod = "{type: distance, " + ends, strut = "{type: strut, " + ends;
  EXPECT_THAT(message(rod + "spring: {stiffness: 1}, " + kAllNodes), HasSubstr("use type: strut"));
  EXPECT_THAT(message(rod + "motor: {to: 90 deg, factor: {type: smooth_step, end: 1}}, " + kAllNodes),
              HasSubstr("motor.to"));
  EXPECT_THAT(message(rod + "motor: {to: -0.9, factor: {type: smooth_step, end: 1}}, " + kAllNodes),
              HasSubstr("must stay above 0"));
  EXPECT_THAT(message(rod + "motor: {to: 0.9, factor: {type: constant}}, " + kAllNodes), HasSubstr("at the start"));
  EXPECT_THAT(message(strut + kAllNodes), HasSubstr("give a spring, stop, friction or load"));
  EXPECT_THAT(message(strut + "motor: " + kMotor + ", " + kAllNodes), HasSubstr("use type: distance"));
  EXPECT_THAT(message(strut + "stop: {low: -0.9, stiffness: 1}, " + kAllNodes), HasSubstr("must be above -0.806"));
  EXPECT_THAT(message("{type: ball, name: a, motor: " + kMotor + ", " + pin), HasSubstr("slider and distance"));
  EXPECT_THAT(message("{type: slider, along: turn, " + ends + kAllNodes), HasSubstr("type cylindrical"));
  EXPECT_THAT(message("{type: cylindrical, along: turn, load: {amount: 1 N}, " + ends + kAllNodes),
              HasSubstr("load.amount"));
}

TEST(Joints, VelocitiesThatTheyForbidAreTold) {
  const std::string ball = "{type: ball, name: a, at: [1, 0.1, 0.1], first: {surface: upper.x1}}";
  const BuiltTestScene forbidden(two_bars(ball, "initial: {velocity: [1, 0, 0]}")), rest(two_bars(ball, ""));
  EXPECT_THAT(forbidden.built.warnings, testing::Contains(testing::HasSubstr("the joints forbid")));
  EXPECT_THAT(rest.built.warnings, testing::Not(testing::Contains(testing::HasSubstr("the joints forbid"))));
}

}  // namespace
}  // namespace orthodyn::joints_test
