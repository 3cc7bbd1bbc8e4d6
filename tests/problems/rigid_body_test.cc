// Motions of rigid bodies and of driven joints, against exact solutions.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <set>

#include "lib/ode/constraints.h"
#include "lib/simulation/output/balance.h"
#include "tests/problems/running.h"

namespace orthodyn::rigid_motion_test {
namespace {

const double kPi = std::acos(-1.0);

struct Motion {
  State last;
  double drift = 0;  // of the energy balance, J
};

Motion motion_of(const BuiltTestScene& s, const std::function<void(const State&)>& at_each_step = {}) {
  const auto integrator = s.scene.integrator->make(s.model(), task_of(s.scene, s.built));
  EnergyMeter meter(s.model(), *integrator);
  StepWatch watch(at_each_step);
  const Outcome outcome =
      run(s.model(), *integrator, s.built.initial, {s.scene.time.end, {}, false}, {&meter, &watch}, {false});
  EXPECT_EQ(outcome.status, Outcome::Status::completed) << outcome.message;
  return {outcome.last, meter.drift()};
}

// A rigid box of 1 m x 0.4 m x 0.2 m and 40 kg about the origin.
std::string box(const std::string& more, double rtol, const std::string& method = "ida_bdf") {
  return fmt::format(R"(
mesh: {{type: box, size: [1, 0.4, 0.2], cells: [2, 1, 1], order: 1, origin: [-0.5, -0.2, -0.1]}}
materials: {{m: {{type: isotropic, density: 500, young: 1e4, nu: 0.3}}}}
regions: {{all: {{material: m, rigid: true}}}}
integrator: {{type: {}, rtol: {}}}
{}
)",
                     method, rtol, more);
}

// Rotation R and angular momentum L about the fixed point, by RK4 with many steps: R' = [J^-1 L] R and L' = torque(R),
// with J = R inertia R^T.
struct Turning {
  Mat3 R = Mat3::Identity();
  Vec3 L = Vec3::Zero();
};

Turning exact_turning(const Vec3& inertia, const Vec3& spin, double end,
                      const std::function<Vec3(const Mat3&)>& torque) {
  const int steps = 20000;
  const double h = end / steps;
  const auto rate = [&](const Turning& x) {
    const Vec3 w = x.R * (x.R.transpose() * x.L).cwiseQuotient(inertia);
    Mat3 cross;
    cross << 0, -w[2], w[1], w[2], 0, -w[0], -w[1], w[0], 0;
    return Turning{cross * x.R, torque(x.R)};
  };
  const auto plus = [](const Turning& x, double s, const Turning& k) { return Turning{x.R + s * k.R, x.L + s * k.L}; };
  Turning x{Mat3::Identity(), inertia.cwiseProduct(spin)};
  for (int i = 0; i < steps; ++i) {
    const Turning k1 = rate(x), k2 = rate(plus(x, h / 2, k1)), k3 = rate(plus(x, h / 2, k2)), k4 = rate(plus(x, h, k3));
    x = plus(x, h / 6, k1);
    x = plus(x, h / 3, k2);
    x = plus(x, h / 3, k3);
    x = plus(x, h / 6, k4);
  }
  return x;
}

// Largest distance of nodes from R X.
double error_of(const BuiltTestScene& s, const Vector& q, const Mat3& R) {
  return (s.positions(q) - R * *s.model().parts().rest).colwise().norm().maxCoeff();
}

const Vec3 kInertia = 40.0 / 12 * Vec3(0.4 * 0.4 + 0.2 * 0.2, 1 + 0.2 * 0.2, 1 + 0.4 * 0.4);

// About its middle axis, a free body turns over (Dzhanibekov).
TEST(RigidBodies, TurnOverAboutTheMiddleAxis) {
  const Vec3 spin(0.02, 4, 0);
  const double end = 4;
  const Turning exact = exact_turning(kInertia, spin, end, [](const Mat3&) -> Vec3 { return Vec3::Zero(); });
  ASSERT_LE(exact.R(1, 1), 0.9);  // it does turn over
  double last = 1;
  for (const double rtol : {1e-5, 1e-7}) {
    const BuiltTestScene s(
        box(fmt::format("initial: {{spin: [{}, {}, {}]}}\ntime: {{end: {}}}", spin[0], spin[1], spin[2], end), rtol));
    const Motion motion = motion_of(s);
    const double error = error_of(s, motion.last.q, exact.R);
    EXPECT_LE(error, 3e3 * rtol);
    EXPECT_LE(error, 0.1 * last);
    last = error;
    const auto L = s.model().evaluate("momentum.angular", motion.last);
    EXPECT_LE((Vec3(L[0], L[1], L[2]) - kInertia.cwiseProduct(spin)).norm(),
              300 * rtol * kInertia.cwiseProduct(spin).norm());
    EXPECT_LE(std::abs(motion.drift), 300 * rtol * 0.5 * spin.dot(kInertia.cwiseProduct(spin)));
  }
}

// Two halves of the box with a fixed joint turn over as the whole box does, whether they are rigid or only stiff.
TEST(FixedJoint, OfTwoHalvesMakesThemOneBody) {
  const Vec3 spin(0.02, 4, 0);
  const double end = 4;
  const Turning exact = exact_turning(kInertia, spin, end, [](const Mat3&) -> Vec3 { return Vec3::Zero(); });
  for (const char* regions : {"all: {material: m, rigid: true}", "all: {material: m}",
                              "left: {material: m, rigid: true}, right: {material: m}"}) {
    const BuiltTestScene s(fmt::format(R"(
mesh:
  type: bodies
  bodies:
    left: {{mesh: {{type: box, size: [0.5, 0.4, 0.2], cells: [1, 1, 1], order: 1, origin: [-0.5, -0.2, -0.1]}}}}
    right: {{mesh: {{type: box, size: [0.5, 0.4, 0.2], cells: [1, 1, 1], order: 1, origin: [0, -0.2, -0.1]}}}}
materials: {{m: {{type: isotropic, density: 500, young: 1e9, nu: 0.3}}}}
regions: {{{}}}
joints: [{{type: fixed, name: weld, at: [0, 0, 0], first: {{surface: left.x1}}, second: {{surface: right.x0}}}}]
mass: consistent
damping: {{stiffness: 1e-4}}
initial: {{spin: [0.02, 4, 0]}}
time: {{end: {}}}
integrator: {{type: ida_bdf, rtol: 1e-7}}
)",
                                       regions, end));
    const Motion motion = motion_of(s);
    EXPECT_LE(error_of(s, motion.last.q, exact.R), 2e-3) << regions;
    EXPECT_LE(s.model().evaluate("joints.gap", motion.last)[0], 1e-6) << regions;
    const auto L = s.model().evaluate("momentum.angular", motion.last);
    EXPECT_LE((Vec3(L[0], L[1], L[2]) - kInertia.cwiseProduct(spin)).norm(), 1e-3 * 40) << regions;
  }
}

// A box that is fixed in space by a joint at its end stays at rest: the force of the joint is its weight.
TEST(FixedJoint, CarriesABoxByItsEnd) {
  const BuiltTestScene s(
      box("joints: [{type: fixed, name: wall, at: [-0.5, 0, 0], first: {region: body}}]\n"
          "gravity: [0, 0, -10]\ntime: {end: 1}",
          1e-5));
  const Motion motion = motion_of(s);
  EXPECT_LE((s.positions(motion.last.q) - *s.model().parts().rest).colwise().norm().maxCoeff(), 1e-9);
  const auto force = s.model().evaluate("joint.wall", motion.last);
  EXPECT_LE((Vec3(force[0], force[1], force[2]) - Vec3(0, 0, 400)).norm(), 1e-6 * 400);
  const auto torque = s.model().evaluate("joint_torque.wall", motion.last);  // of the weight at the arm of 0.5 m
  EXPECT_LE((Vec3(torque[0], torque[1], torque[2]) - Vec3(0, -200, 0)).norm(), 1e-6 * 200);
}

// A heavy top: a square bar that spins about a ball joint at one end.
TEST(RigidBodies, PrecessAsAHeavyTop) {
  const double end = 1.5, mass = 40, length = 1;
  const Vec3 spin(20, 0, 0), centre(length / 2, 0, 0);
  Vec3 inertia = mass / 12 * Vec3(2 * 0.3 * 0.3, 1 + 0.09, 1 + 0.09);
  inertia += mass * 0.25 * Vec3(0, 1, 1);
  const Turning exact = exact_turning(
      inertia, spin, end, [&](const Mat3& R) -> Vec3 { return (R * centre).cross(Vec3(0, 0, -10 * mass)); });
  ASSERT_GE((exact.R.col(0) - Vec3::UnitX()).norm(), 0.5);
  double last = 1;
  for (const double rtol : {1e-5, 1e-7}) {
    const BuiltTestScene s(fmt::format(R"(
mesh: {{type: box, size: [1, 0.3, 0.3], cells: [2, 1, 1], order: 1, origin: [0, -0.15, -0.15]}}
materials: {{m: {{type: isotropic, density: {}, young: 1e4, nu: 0.3}}}}
regions: {{all: {{material: m, rigid: true}}}}
joints: [{{type: ball, name: foot, at: [0, 0, 0], first: {{region: body}}}}]
gravity: [0, 0, -10]
initial: {{spin: [20, 0, 0], center: [0, 0, 0]}}
time: {{end: {}}}
integrator: {{type: ida_bdf, rtol: {}}}
)",
                                       mass / 0.09, end, rtol));
    const Motion motion = motion_of(s);
    const double error = error_of(s, motion.last.q, exact.R);
    EXPECT_LE(error, 1e4 * rtol);
    EXPECT_LE(error, 0.1 * last);
    last = error;
  }
}

// The same top with its inertia given, on a small cube beside it.
TEST(RigidBodies, PrecessWithAGivenInertia) {
  const double end = 1.5, mass = 40;
  const Vec3 spin(20, 0, 0), centre(0.5, 0, 0);
  const Vec3 about_centre = mass / 12 * Vec3(2 * 0.3 * 0.3, 1 + 0.09, 1 + 0.09);
  const Turning exact =
      exact_turning(about_centre + mass * 0.25 * Vec3(0, 1, 1), spin, end,
                    [&](const Mat3& R) -> Vec3 { return (R * centre).cross(Vec3(0, 0, -10 * mass)); });
  double last = 1;
  for (const double rtol : {1e-5, 1e-7}) {
    const BuiltTestScene s(fmt::format(R"(
mesh: {{type: box, size: [0.1, 0.1, 0.1], cells: [1, 1, 1], order: 1, origin: [0.1, 0.1, 0.1]}}
materials: {{m: {{type: isotropic, density: 1, young: 1e4, nu: 0.3}}}}
regions: {{all: {{material: m, rigid: {{mass: {}, center: [0.5, 0, 0], inertia: [{}, {}, {}]}}}}}}
joints: [{{type: ball, name: foot, at: [0, 0, 0], first: {{region: body}}}}]
gravity: [0, 0, -10]
initial: {{spin: [20, 0, 0], center: [0, 0, 0]}}
time: {{end: {}}}
integrator: {{type: ida_bdf, rtol: {}}}
)",
                                       mass, about_centre[0], about_centre[1], about_centre[2], end, rtol));
    const Motion motion = motion_of(s);
    const double error = error_of(s, motion.last.q, exact.R);
    EXPECT_LE(error, 1e4 * rtol);
    EXPECT_LE(error, 0.1 * last);
    last = error;
  }
}

// A motor turns the box about a hinge at its end by a smooth step of 200 degrees: torque = J th'' + m g l cos th.
// The motor prescribes the whole motion: nothing is left to integrate, and each error is an error of the constraints.
class Motors : public testing::TestWithParam<const char*> {};
INSTANTIATE_TEST_SUITE_P(Methods, Motors, testing::Values("ida_bdf", "cvode_bdf", "generalized_alpha"));

TEST_P(Motors, TurnWithTheExactTorque) {
  const BuiltTestScene s(box(R"(
joints:
  - type: hinge
    name: arm
    from: [-0.5, 0, 0]
    to: [-0.5, -1, 0]
    first: {region: body}
    motor: {to: 200 deg, factor: {type: expression, formula: '0.5*(1 - cos(pi*t))'}}
gravity: [0, 0, -10]
time: {end: 0.8}
)",
                             1e-7, GetParam()));
  const Motion motion = motion_of(s);
  const double A = 200 * kPi / 180 / 2, angle = A * (1 - std::cos(0.8 * kPi));
  const double acceleration = A * kPi * kPi * std::cos(0.8 * kPi);
  const Mat3 R = Eigen::AngleAxisd(angle, -Vec3::UnitY()).toRotationMatrix();
  const Vec3 foot(-0.5, 0, 0);
  const NodalVector x = s.positions(motion.last.q);
  for (Eigen::Index i = 0; i < x.cols(); ++i)
    EXPECT_LE((x.col(i) - (R * (s.model().parts().rest->col(i) - foot) + foot)).norm(), 1e-5);
  const double torque = (kInertia[1] + 40 * 0.25) * acceleration + 40 * 10 * 0.5 * std::cos(angle);
  EXPECT_NEAR(s.model().evaluate("motor.arm", motion.last)[0], torque, 1e-3 * std::abs(torque));
  EXPECT_NEAR(s.model().evaluate("coordinate.arm", motion.last)[0], angle, 1e-5);
  EXPECT_LE(std::abs(motion.drift), 1e-4 * 40 * 10 * 0.5);  // the work of the motor is in the balance
}

TEST_P(Motors, PushWithTheExactForce) {
  const BuiltTestScene s(box(R"(
joints:
  - type: slider
    name: rail
    from: [0, 0, 0]
    to: [0, 1, 0]
    first: {region: body}
    motor: {to: 0.5, factor: {type: expression, formula: 't^2'}}
time: {end: 1}
)",
                             1e-6, GetParam()));
  const Motion motion = motion_of(s);
  EXPECT_NEAR(s.model().evaluate("motor.rail", motion.last)[0], 40, 1e-3 * 40);
  EXPECT_NEAR(s.model().evaluate("coordinate.rail", motion.last)[0], 0.5, 1e-5);
  EXPECT_LE(std::abs(motion.drift), 1e-3 * 20);
}

// A motor turns the box about a line along which the box slides freely: torque = J th'', and the slide is v t.
TEST_P(Motors, TurnABoxThatSlides) {
  const BuiltTestScene s(box(R"(
joints:
  - type: cylindrical
    along: turn
    name: rail
    from: [0, 0, 0]
    to: [0, 1, 0]
    first: {region: body}
    motor: {to: 200 deg, factor: {type: expression, formula: '0.5*(1 - cos(pi*t))'}}
initial: {velocity: [0, 0.7, 0]}
time: {end: 0.8}
)",
                             1e-7, GetParam()));
  const Motion motion = motion_of(s);
  const double A = 200 * kPi / 180 / 2, angle = A * (1 - std::cos(0.8 * kPi));
  const double torque = kInertia[1] * A * kPi * kPi * std::cos(0.8 * kPi);
  const Mat3 R = Eigen::AngleAxisd(angle, Vec3::UnitY()).toRotationMatrix();
  const NodalVector x = s.positions(motion.last.q);
  for (Eigen::Index i = 0; i < x.cols(); ++i)
    EXPECT_LE((x.col(i) - R * s.model().parts().rest->col(i) - Vec3(0, 0.56, 0)).norm(), 1e-5);
  const auto value = [&](const char* name) { return s.model().evaluate(name, motion.last)[0]; };
  EXPECT_NEAR(value("motor.rail"), torque, 1e-3 * std::abs(torque));
  EXPECT_NEAR(value("coordinate.rail"), angle, 1e-5);
  EXPECT_NEAR(value("angle.rail"), value("coordinate.rail"), 1e-14);
  EXPECT_NEAR(value("slide.rail"), 0.56, 1e-5);
  EXPECT_LE(std::abs(motion.drift), 1e-4 * std::abs(torque));
}

// The mean of the nodes of a region, which is the centre of a box.
Vec3 centre_of(const BuiltTestScene& s, const Vector& q, int region) {
  const NodalVector x = s.positions(q);
  std::set<int> nodes;
  for (std::size_t k = 0; k < s.mesh().cells.size(); ++k)
    if (s.mesh().region_of[k] == region) nodes.insert(s.mesh().cells[k].begin(), s.mesh().cells[k].end());
  Vec3 sum = Vec3::Zero();
  for (const int node : nodes) sum += x.col(node);
  return sum / static_cast<double>(nodes.size());
}

// Two free boxes of 40 and 24 kg, whose centres are 2.3 m apart along x.
std::string two_boxes(const std::string& joint, double end, double rtol, const char* method) {
  return fmt::format(R"(
mesh:
  type: bodies
  bodies:
    a: {{mesh: {{type: box, size: [1, 0.4, 0.2], cells: [1, 1, 1], elements: hexahedra, order: 1, origin: [-0.5, -0.2, -0.1]}}}}
    b: {{mesh: {{type: box, size: [0.6, 0.4, 0.2], cells: [1, 1, 1], elements: hexahedra, order: 1, origin: [2, -0.2, -0.1]}}}}
materials: {{m: {{type: isotropic, density: 500, young: 1e4, nu: 0.3}}}}
regions: {{all: {{material: m, rigid: true}}}}
joints: [{{name: leg, from: [2.3, 0, 0], to: [0, 0, 0], first: {{region: b}}, second: {{region: a}}, {}}}]
time: {{end: {}}}
integrator: {{type: {}, rtol: {}}}
)",
                     joint, end, method, rtol);
}
constexpr double kReduced = 40.0 * 24 / 64;  // kg

// A motor changes the distance of the boxes by m(t): their centres move by -24/64 m and 40/64 m, and the force is the
// reduced mass times m''.
TEST_P(Motors, DriveFreeBoxesApart) {
  const BuiltTestScene s(
      two_boxes("type: distance, motor: {to: 0.5, factor: {type: expression, formula: '0.5*(1 - cos(pi*t))'}}", 0.8,
                1e-7, GetParam()));
  const Motion motion = motion_of(s);
  const double change = 0.25 * (1 - std::cos(0.8 * kPi)), force = kReduced * 0.25 * kPi * kPi * std::cos(0.8 * kPi);
  EXPECT_LE((centre_of(s, motion.last.q, 0) - Vec3(-change * 24 / 64, 0, 0)).norm(), 1e-5);
  EXPECT_LE((centre_of(s, motion.last.q, 1) - Vec3(2.3 + change * 40 / 64, 0, 0)).norm(), 1e-5);
  EXPECT_NEAR(s.model().evaluate("coordinate.leg", motion.last)[0], change, 1e-5);
  EXPECT_NEAR(s.model().evaluate("motor.leg", motion.last)[0], force, 1e-3 * std::abs(force));
  const auto joint = s.model().evaluate("joint.leg", motion.last);
  EXPECT_LE((Vec3(joint[0], joint[1], joint[2]) - Vec3(force, 0, 0)).norm(), 1e-3 * std::abs(force));
  EXPECT_LE(std::abs(motion.drift), 2e-3);
}

// A motor shortens the rod on which the box turns about a point, without gravity: r^2 th' is constant, and the force of
// the motor is m (r'' - r th'^2).
TEST_P(Motors, ShortenAPendulum) {
  const BuiltTestScene s(box(R"(
joints:
  - type: distance
    name: rod
    from: [0, 0, 0]
    to: [0, 0, -1]
    first: {region: body}
    motor: {to: -0.4, factor: {type: expression, formula: '0.5*(1 - cos(pi*t))'}}
initial: {velocity: [2, 0, 0]}
time: {end: 0.8}
)",
                             1e-7, GetParam()));
  const Motion motion = motion_of(s);
  const auto radius = [](double t) { return 1 - 0.2 * (1 - std::cos(kPi * t)); };
  const int steps = 1000;  // Simpson's rule for th = int 2/r^2 dt
  double angle = 0;
  for (int k = 0; k <= steps; ++k)
    angle += (k == 0 || k == steps ? 1 : k % 2 == 1 ? 4 : 2) * 2 / std::pow(radius(0.8 * k / steps), 2);
  angle *= 0.8 / steps / 3;
  const double r = radius(0.8), r_second = -0.2 * kPi * kPi * std::cos(0.8 * kPi);
  const Vec3 exact(r * std::sin(angle), 0, r * std::cos(angle) - 1);
  EXPECT_LE((centre_of(s, motion.last.q, 0) - exact).norm(), 1e-4);
  const double force = 40 * (r_second - 4 / (r * r * r));
  EXPECT_NEAR(s.model().evaluate("motor.rod", motion.last)[0], force, 1e-3 * std::abs(force));
  EXPECT_LE(std::abs(motion.drift), 1e-3 * 80);  // the work of the motor is in the balance
}

// A damped spring between the free boxes: c(t) = v/w exp(-d t) sin(w t) with the reduced mass.
TEST(Struts, SwingExactly) {
  const double k = 25 * kReduced, c = 0.5 * kReduced, speed = 0.4;
  double first = 0, last = 0;
  for (const double rtol : {1e-4, 1e-6, 1e-8}) {
    const BuiltTestScene s(
        two_boxes(fmt::format("type: strut, spring: {{stiffness: {}, damping: {}}}", k, c), 1.3, rtol, "ida_bdf") +
        fmt::format("initial: {{velocity_field: ['x > 1 ? {} : 0', 0, 0]}}\n", speed));
    const Motion motion = motion_of(s);
    const double d = 0.25, w = std::sqrt(25 - d * d), exact = speed / w * std::exp(-1.3 * d) * std::sin(1.3 * w);
    const double error = std::abs(s.model().evaluate("coordinate.leg", motion.last)[0] - exact);
    EXPECT_LE(error, 100 * rtol * speed);
    last = error;
    if (first == 0) first = error;
    const double momentum = 24 * speed;
    EXPECT_NEAR(s.model().evaluate("momentum.linear", motion.last)[0], momentum, 300 * rtol * momentum);
    EXPECT_LE(std::abs(motion.drift), 1e3 * rtol * kReduced * speed * speed);
  }
  EXPECT_LE(last, 0.1 * first);
}

// A spring of 320 N/m, stretched by 0.5 m, holds the box of 40 kg on a circle of 1 m at 2 m/s.
TEST(Struts, HoldACircularOrbit) {
  for (const double rtol : {1e-5, 1e-7}) {
    const BuiltTestScene s(box(R"(
joints: [{type: strut, name: leg, from: [0, 0, 0], to: [0, 0, -1], first: {region: body}, spring: {stiffness: 320, rest: -0.5}}]
initial: {velocity: [2, 0, 0]}
time: {end: 1}
)",
                               rtol));
    const Motion motion = motion_of(s);
    EXPECT_LE((centre_of(s, motion.last.q, 0) - Vec3(std::sin(2.0), 0, std::cos(2.0) - 1)).norm(), 1e3 * rtol);
    EXPECT_LE(std::abs(s.model().evaluate("coordinate.leg", motion.last)[0]), 1e3 * rtol);
  }
}

// A cable that is slack up to 0.1 m: the boxes part with 0.4 m/s, the stop stretches by v sqrt(m/k) and throws them
// back without loss.
TEST(Struts, WithAStopAreCables) {
  double longest = 0;
  const BuiltTestScene s(
      two_boxes(fmt::format("type: strut, stop: {{high: 0.1, stiffness: {}, onset: 1e-5}}", 2500 * kReduced), 0.5, 1e-7,
                "ida_bdf") +
      "initial: {velocity_field: ['x > 1 ? 0.4 : 0', 0, 0]}\n");
  const auto coordinate = [&](const State& state) { return s.model().evaluate("coordinate.leg", state)[0]; };
  const Motion motion = motion_of(s, [&](const State& state) { longest = std::max(longest, coordinate(state)); });
  const double depth = 0.4 / 50;
  EXPECT_NEAR(longest, 0.1 + depth, 0.02 * depth);
  EXPECT_LT(coordinate(motion.last), 0.1 - depth);
  EXPECT_LE(std::abs(motion.drift), 2e-4 * kReduced * 0.08);
}

// A motor turns the crank of a slider-crank: the slider is at r cos(th) + sqrt(l^2 - r^2 sin^2(th)).
TEST(Mechanisms, OfSliderAndCrankMoveExactly) {
  const BuiltTestScene s(R"(
mesh:
  type: bodies
  bodies:
    crank: {mesh: {type: box, size: [0.22, 0.02, 0.02], cells: [1, 1, 1], order: 1, origin: [-0.01, -0.01, -0.01]}}
    rod: {mesh: {type: box, size: [0.52, 0.02, 0.02], cells: [1, 1, 1], order: 1, origin: [0.19, 0.02, -0.01]}}
    block: {mesh: {type: box, size: [0.1, 0.06, 0.06], cells: [1, 1, 1], order: 1, origin: [0.65, -0.01, -0.03]}}
materials: {steel: {type: isotropic, density: 7800, young: 2e11, nu: 0.3}}
regions: {all: {material: steel, rigid: true}}
joints:
  - type: hinge
    name: bearing
    from: [0, 0, 0]
    to: [0, 0.02, 0]
    first: {region: crank}
    motor: {to: 1 rad, factor: {type: expression, formula: '10*t'}}
  - {type: ball, name: pin, at: [0.2, 0.02, 0], first: {region: rod}, second: {region: crank}}
  - {type: ball, name: wrist, at: [0.7, 0.02, 0], first: {region: block}, second: {region: rod}}
  - {type: slider, name: rail, from: [0.7, 0.02, 0], to: [0.8, 0.02, 0], first: {region: block}}
initial: {velocity_field: ['0', '0', 'x < 0.211 ? -10*x : (x < 0.711 ? -4*(0.7 - x) : 0)']}
time: {end: 1}
integrator: {type: ida_bdf, rtol: 1e-6}
)");
  double worst = -1;
  motion_of(s, [&](const State& state) {
    const double angle = 10 * state.t, lift = 0.2 * std::sin(angle);
    const double exact = 0.2 * std::cos(angle) + std::sqrt(0.25 - lift * lift) - 0.7;
    worst = std::max(worst, std::abs(s.model().evaluate("coordinate.rail", state)[0] - exact));
  });
  EXPECT_GE(worst, 0);
  EXPECT_LE(worst, 1e-5);
}

// The box moves with 2 m/s along a line, or turns with 2 rad/s about it.
struct Freedom {
  const char *type, *start;
  double inertia;  // kg, or kg m^2
};
class ForcesOfJoints : public testing::TestWithParam<Freedom> {
 protected:
  const double inertia = GetParam().inertia, energy = 2 * inertia;  // J
  BuiltTestScene moving(const std::string& forces, double end, double rtol) const {
    return BuiltTestScene(
        box(fmt::format("joints: [{{type: {}, name: rail, from: [0, 0, 0], to: [0, 1, 0], first: {{region: body}}, "
                        "{}}}]\ninitial: {{{}: [0, 2, 0]}}\ntime: {{end: {}}}",
                        GetParam().type, forces, GetParam().start, end),
            rtol));
  }
  static double coordinate(const BuiltTestScene& s, const State& state) {
    return s.model().evaluate("coordinate.rail", state)[0];
  }
};
INSTANTIATE_TEST_SUITE_P(Types, ForcesOfJoints,
                         testing::Values(Freedom{"slider", "velocity", 40}, Freedom{"hinge", "spin", kInertia[1]},
                                         Freedom{"cylindrical", "velocity", 40},
                                         Freedom{"cylindrical, along: turn", "spin", kInertia[1]}));

// The box hits a stop at 0.5 m or rad: it turns back at the depth v sqrt(m/k) (beyond the onset), and loses no energy.
TEST_P(ForcesOfJoints, StopsThrowBackWithoutLoss) {
  double highest = 0;
  const BuiltTestScene s =
      moving(fmt::format("stop: {{high: 0.5, stiffness: {}, onset: 1e-4}}", 2500 * inertia), 0.6, 1e-7);
  const Motion motion = motion_of(s, [&](const State& state) { highest = std::max(highest, coordinate(s, state)); });
  const double depth = 2 * std::sqrt(1 / 2500.0);
  EXPECT_NEAR(highest, 0.5 + depth, 0.02 * depth);
  EXPECT_NEAR(s.model().evaluate("energy.kinetic", motion.last)[0], energy, 1e-4 * energy);
  EXPECT_LT(coordinate(s, motion.last), 0.5);
  EXPECT_LE(std::abs(motion.drift), 1e-4 * energy);
}

// Friction F brings the box to rest after v^2/(2 F/m); its heat is the kinetic energy.
TEST_P(ForcesOfJoints, FrictionStopsTheBox) {
  const BuiltTestScene s = moving(fmt::format("friction: {{limit: {}, creep: 1e-3}}", 2 * inertia), 2, 1e-6);
  const Motion motion = motion_of(s);
  EXPECT_NEAR(coordinate(s, motion.last), 1, 5e-3);
  EXPECT_LE(s.model().evaluate("energy.kinetic", motion.last)[0], 1e-6 * energy);
  EXPECT_LE(std::abs(motion.drift), 1e-3 * energy);
}

// A damped spring: x(t) = v/w exp(-d t) sin(w t) with d = c/(2 m) and w^2 = k/m - d^2.
TEST_P(ForcesOfJoints, SpringsSwingExactly) {
  const BuiltTestScene s =
      moving(fmt::format("spring: {{stiffness: {}, damping: {}}}", 25 * inertia, 0.5 * inertia), 1.3, 1e-7);
  const Motion motion = motion_of(s);
  const double d = 0.25, w = std::sqrt(25 - d * d), exact = 2 / w * std::exp(-1.3 * d) * std::sin(1.3 * w);
  EXPECT_NEAR(coordinate(s, motion.last), exact, 1e-5);
  EXPECT_LE(std::abs(motion.drift), 1e-4 * energy);
}

// A motor between two free boxes turns them against each other: their momenta stay zero.
TEST(Motors, BetweenFreeBodiesKeepMomentum) {
  const BuiltTestScene s(R"(
mesh:
  type: bodies
  bodies:
    a: {mesh: {type: box, size: [1, 0.4, 0.2], cells: [1, 1, 1], order: 1, origin: [-1, -0.2, -0.1]}}
    b: {mesh: {type: box, size: [0.6, 0.4, 0.2], cells: [1, 1, 1], order: 1, origin: [0, -0.2, -0.1]}}
materials: {m: {type: isotropic, density: 500, young: 1e4, nu: 0.3}}
regions: {all: {material: m, rigid: true}}
joints:
  - type: hinge
    name: knee
    from: [0, 0, 0]
    to: [0, 1, 0]
    first: {region: b}
    second: {region: a}
    motor: {to: 100 deg, factor: {type: smooth_step, end: 1}}
time: {end: 0.6}
integrator: {type: ida_bdf, rtol: 1e-6}
)");
  const Motion motion = motion_of(s);
  const double u = 0.6, wanted = 100 * kPi / 180 * u * u * u * (10 - 15 * u + 6 * u * u);
  EXPECT_NEAR(s.model().evaluate("coordinate.knee", motion.last)[0], wanted, 1e-5);
  const double size = std::sqrt(2 * 64 * s.model().evaluate("energy.kinetic", motion.last)[0]);  // kg m/s
  ASSERT_GT(size, 10);
  for (const char* kind : {"momentum.linear", "momentum.angular"})
    for (const double component : s.model().evaluate(kind, motion.last)) EXPECT_LE(std::abs(component), 1e-4 * size);
  EXPECT_LE(std::abs(motion.drift), 1e-4 * size * size / 128);
}

// A torque T cos(t) turns the box by T/J (1 - cos t) about its middle, a force F cos(t) moves it by F/m (1 - cos t).
class LoadsOfJoints : public testing::TestWithParam<std::pair<const char*, double>> {};
INSTANTIATE_TEST_SUITE_P(Types, LoadsOfJoints,
                         testing::Values(std::pair("hinge", kInertia[1]), std::pair("slider", 40.0),
                                         std::pair("cylindrical, along: turn", kInertia[1])));

TEST_P(LoadsOfJoints, MoveExactly) {
  const auto& [type, inertia] = GetParam();
  const double end = 2, amount = 20;
  double last = 1;
  for (const double rtol : {1e-5, 1e-7}) {
    const BuiltTestScene s(box(
        fmt::format("joints: [{{type: {}, name: rail, from: [0, 0, 0], to: [0, 1, 0], first: {{region: body}}, load: "
                    "{{amount: {}, factor: {{type: expression, formula: 'cos(t)'}}}}}}]\ntime: {{end: {}}}",
                    type, amount, end),
        rtol));
    const Motion motion = motion_of(s);
    const double exact = amount / inertia * (1 - std::cos(end));
    const double found = s.model().evaluate("coordinate.rail", motion.last)[0];
    const double error = std::abs(found - exact);
    EXPECT_LE(error, 1e3 * rtol * exact);
    EXPECT_LE(error, 0.2 * last);
    const double rate = amount / inertia * std::sin(end);
    EXPECT_NEAR(s.model().evaluate("power.loads", motion.last)[0], amount * std::cos(end) * rate, 1e3 * rtol * amount);
    EXPECT_LE(std::abs(motion.drift), 1e3 * rtol * 0.5 * inertia * std::pow(amount / inertia, 2));
    last = error;
  }
}

}  // namespace
}  // namespace orthodyn::rigid_motion_test
