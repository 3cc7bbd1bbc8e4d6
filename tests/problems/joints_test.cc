// Motions with joints: pendulums with exact solutions, conservation, and the methods that are refused.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "lib/ode/constraints.h"
#include "lib/simulation/output/balance.h"
#include "tests/problems/running.h"

namespace orthodyn::joint_motion_test {
namespace {

// A stiff block of 1 kg on a massless rod of 1 m, released at rest at 90 degrees: the force of the rod passes through
// its centre, so it moves as a point does.
std::string pendulum(const std::string& integrator) {
  return fmt::format(R"(
mesh: {{type: box, size: [0.1, 0.1, 0.1], cells: [1, 1, 1], order: 1, origin: [0.95, -0.05, -0.05]}}
materials: {{m: {{type: isotropic, density: 1000, young: 1e8, nu: 0.3}}}}
gravity: [0, 0, -10]
joints: [{{type: distance, name: rod, from: [1, 0, 0], to: [0, 0, 0], first: {{box: {{min: [0.9, -1, -1], max: [1.1, 1, 1]}}}}}}]
time: {{end: 1.5}}
integrator: {{{}}}
)",
                     integrator);
}

// Angle from the vertical and its rate by RK4 with many steps: th'' = -10 sin th.
std::array<double, 2> exact_pendulum(double end) {
  std::array<double, 2> y{std::acos(-1.0) / 2, 0};
  const int steps = 20000;
  const double h = end / steps;
  const auto f = [](const std::array<double, 2>& x) { return std::array<double, 2>{x[1], -10 * std::sin(x[0])}; };
  const auto plus = [](std::array<double, 2> a, double s, const std::array<double, 2>& b) {
    return std::array<double, 2>{a[0] + s * b[0], a[1] + s * b[1]};
  };
  for (int k = 0; k < steps; ++k) {
    const auto k1 = f(y), k2 = f(plus(y, h / 2, k1)), k3 = f(plus(y, h / 2, k2)), k4 = f(plus(y, h, k3));
    for (std::size_t i = 0; i < 2; ++i) y[i] += h / 6 * (k1[i] + 2 * k2[i] + 2 * k3[i] + k4[i]);
  }
  return y;
}

struct Motion {
  State last;
  double gap = 0, rate = 0;     // the largest of all steps, m, m/s
  double drift = 0, steps = 0;  // of the energy balance, J
};

Motion motion_of(const BuiltTestScene& s) {
  const auto integrator = s.scene.integrator->make(s.model(), task_of(s.scene, s.built));
  EnergyMeter meter(s.model(), *integrator);
  Motion out;
  StepWatch watch([&](const State& state) {
    out.gap = std::max(out.gap, s.model().evaluate("joints.gap", state)[0]);
    out.rate = std::max(out.rate, s.model().evaluate("joints.rate", state)[0]);
  });
  const Outcome outcome =
      run(s.model(), *integrator, s.built.initial, {s.scene.time.end, {}, false}, {&meter, &watch}, {false});
  EXPECT_EQ(outcome.status, Outcome::Status::completed) << outcome.message;
  out.last = outcome.last;
  out.gap = std::max(out.gap, s.model().evaluate("joints.gap", outcome.last)[0]);
  out.drift = meter.drift();
  out.steps = static_cast<double>(integrator->statistics().steps);
  return out;
}

Vec3 centre(const BuiltTestScene& s, const Vector& q) { return s.positions(q).rowwise().mean(); }

struct PendulumErrors {
  double place = 0, tension = 0, direction = 0;  // m; relative; of the rod's force
  double gap = 0;                                // m
};

// At the end of the motion.
PendulumErrors pendulum_errors(const std::string& integrator) {
  const auto [angle, rate] = exact_pendulum(1.5);
  const Vec3 exact(std::sin(angle), 0, -std::cos(angle));
  const double tension = 10 * std::cos(angle) + rate * rate;
  const BuiltTestScene s(pendulum(integrator));
  const Motion motion = motion_of(s);
  const auto joint = s.model().evaluate("joint.rod", motion.last);
  const Vec3 force(joint[0], joint[1], joint[2]);
  return {(centre(s, motion.last.q) - exact).norm(), std::abs(force.norm() / tension - 1),
          (force.normalized() + exact).norm(), motion.gap};
}

// The tension of cvode_bdf is the least accurate one: it contains vibrations of the block that are below the tolerance.
TEST(Pendulum, OfARodHasTheExactMotionAndTension) {
  for (const char* integrator : {"ida_bdf", "cvode_bdf", "generalized_alpha", "hht_alpha"}) {
    double last_error = 1;
    for (const double rtol : {1e-4, 1e-6}) {
      const PendulumErrors errors = pendulum_errors(fmt::format("type: {}, rtol: {}", integrator, rtol));
      EXPECT_LE(errors.place, 300 * rtol) << integrator;
      EXPECT_LE(errors.place, 0.2 * last_error) << integrator;
      last_error = errors.place;
      EXPECT_LE(errors.gap, 10 * rtol) << integrator;
      EXPECT_LE(errors.tension, 3000 * rtol) << integrator;
      EXPECT_LE(errors.direction, 300 * rtol) << integrator;
    }
  }
}

TEST(Pendulum, ErrorsFallWithTheSquareOfAFixedStep) {
  for (const char* integrator : {"generalized_alpha", "hht_alpha"}) {
    const auto errors = [&](double step) {
      return pendulum_errors(fmt::format("type: {}, rtol: 1e-7, step: {}", integrator, step));
    };
    const PendulumErrors coarse = errors(0.02), fine = errors(0.005);
    EXPECT_NEAR(std::log2(coarse.place / fine.place) / 2, 2, 0.2) << integrator;
    EXPECT_NEAR(std::log2(coarse.tension / fine.tension) / 2, 2, 0.2) << integrator;
  }
}

// The changes of linear and angular momentum, against the z component at the start.
void expect_momentum_kept(const BuiltTestScene& s, const State& last, double tolerance) {
  for (const char* kind : {"momentum.linear", "momentum.angular"}) {
    const auto before = s.model().evaluate(kind, s.built.initial), after = s.model().evaluate(kind, last);
    for (std::size_t c = 0; c < 3; ++c) EXPECT_NEAR(after[c], before[c], tolerance * (std::abs(before[2]) + 1)) << kind;
  }
}

// Two free soft bars with a ball joint, thrown and spinning.
class JointsOf : public testing::TestWithParam<std::string> {};
INSTANTIATE_TEST_SUITE_P(Methods, JointsOf, testing::Values("ida_bdf", "cvode_bdf", "generalized_alpha", "hht_alpha"));

TEST_P(JointsOf, KeepMomentumAndEnergy) {
  const BuiltTestScene s(fmt::format(R"(
mesh:
  type: bodies
  bodies:
    a: {{mesh: {{type: box, size: [1, 0.2, 0.2], cells: [3, 1, 1]}}}}
    b: {{mesh: {{type: box, size: [1, 0.2, 0.2], cells: [3, 1, 1]}}, translation: [1, 0, 0]}}
materials: {{m: {{type: orthotropic_stable, density: 10, young: [4e4, 1e4, 2e4], nu: 0.3}}}}
joints: [{{type: ball, name: link, at: [1, 0.1, 0.1], first: {{surface: a.x1}}, second: {{surface: b.x0}}}}]
initial: {{velocity: [1, 2, 3], velocity_field: ['-3*(y-0.1)', '4*abs(x-1)', 0]}}
damping: {{stiffness: 1e-4}}
time: {{end: 1}}
integrator: {{type: {}, rtol: 1e-6}}
)",
                                     GetParam()));
  const Motion motion = motion_of(s);
  const State& start = s.built.initial;
  expect_momentum_kept(s, motion.last, 2e-5);
  const double energy = s.model().evaluate("energy.kinetic", start)[0];
  EXPECT_LE(std::abs(motion.drift), 1e-4 * energy);
  EXPECT_LE(motion.gap, 1e-12);  // linear constraints hold to round-off
  EXPECT_LE(motion.rate, 1e-9);
  EXPECT_GE((centre(s, motion.last.q) - centre(s, start.q)).norm(), 1);
}

// A block on a line that is inclined by 30 degrees slides without friction: x = g sin(30 deg) t^2 / 2. A slider does
// not let it turn, a slot at its centre neither turns it nor stops it from turning.
TEST(Slider, GoesDownAnInclinedLineAsInFreeFall) {
  for (const char* type : {"slot", "cylindrical", "slider"}) {
    const double c = std::cos(std::acos(-1.0) / 6), end = 0.5;
    const BuiltTestScene s(fmt::format(R"(
mesh: {{type: box, size: [0.1, 0.1, 0.1], cells: [1, 1, 1], order: 1, origin: [-0.05, -0.05, -0.05]}}
materials: {{m: {{type: isotropic, density: 1000, young: 1e8, nu: 0.3}}}}
gravity: [0, 0, -10]
joints: [{{type: {}, name: rail, from: [0, 0, 0], to: [{}, 0, -0.025], first: {{box: {{min: [-1, -1, -1], max: [1, 1, 1]}}}}}}]
time: {{end: {}}}
integrator: {{type: ida_bdf, rtol: 1e-6}}
)",
                                       type, 0.05 * c, end));
    const Motion motion = motion_of(s);
    const double way = 10 * 0.5 * end * end / 2;
    EXPECT_LE((centre(s, motion.last.q) - way * Vec3(c, 0, -0.5)).norm(), 1e-5 * way) << type;
    EXPECT_LE(motion.gap, 1e-6) << type;
    const auto force = s.model().evaluate("joint.rail", motion.last);
    EXPECT_LE((Vec3(force[0], force[1], force[2]) - 10 * c * Vec3(0.5, 0, c)).norm(), 1e-2) << type;  // m g cos(30 deg)
  }
}

// A block is thrown along a free bar in which it slides: on a turning line, r'' = w^2 r, and the angular momentum
// (J + m r^2) w is constant.
TEST_P(JointsOf, KeepMomentumAndEnergyOfABlockThatSlidesOnATurningBar) {
  const BuiltTestScene s(fmt::format(R"(
mesh:
  type: bodies
  bodies:
    bar: {{mesh: {{type: box, size: [2, 0.1, 0.1], cells: [8, 1, 1], origin: [-1, -0.05, -0.05]}}}}
    block: {{mesh: {{type: box, size: [0.2, 0.3, 0.3], cells: [1, 1, 1], origin: [0.2, -0.15, -0.15]}}}}
materials: {{m: {{type: isotropic, density: 100, young: 1e8, nu: 0.3}}}}
joints:
  - type: slider
    name: rail
    from: [0.2, 0, 0]
    to: [0.4, 0, 0]
    first: {{box: {{min: [0.15, -0.2, -0.2], max: [0.45, 0.2, 0.2]}}}}
    second: {{box: {{min: [-0.3, -0.06, -0.06], max: [0.3, 0.06, 0.06]}}}}
initial: {{velocity_field: ['-2*y', '2*x', 0]}}
damping: {{stiffness: 1e-5}}
time: {{end: 1}}
integrator: {{type: {}, rtol: 1e-6}}
)",
                                     GetParam()));
  const Motion motion = motion_of(s);
  const State& start = s.built.initial;
  expect_momentum_kept(s, motion.last, 1e-4);
  EXPECT_LE(std::abs(motion.drift), 1e-4 * s.model().evaluate("energy.kinetic", start)[0]);
  EXPECT_LE(motion.gap, 1e-9);
  EXPECT_LE(motion.rate,
            (GetParam().ends_with("bdf") ? 1 : 5) * 1e-6 * 2);  // rtol of 2 m/s; O(h^2) of the alpha methods
  EXPECT_GE((centre(s, motion.last.q) - centre(s, start.q)).norm(), 0.1);
}

// A rigid bob hangs by a hinge from a soft link, which bends as it swings about a hinge: errors of all methods fall
// with rtol, against a reference by a method of order 5 that one of order 2 confirms.
std::string pendulum_of_a_link(const std::string& integrator) {
  return fmt::format(R"(
mesh:
  type: bodies
  bodies:
    link: {{mesh: {{type: box, size: [1, 0.04, 0.02], cells: [6, 1, 1], elements: hexahedra, origin: [0, -0.02, -0.01]}}}}
    bob: {{mesh: {{type: box, size: [0.2, 0.2, 0.4], cells: [1, 1, 1], elements: hexahedra, origin: [0.9, -0.1, -0.4]}}}}
materials: {{m: {{type: orthotropic_stable, density: 500, young: [2e8, 5e7, 5e7], nu: 0.3}}}}
regions: {{link: {{material: m}}, bob: {{material: m, rigid: true}}}}
gravity: [0, 0, -10]
damping: {{stiffness: 1e-3}}
joints:
  - {{type: hinge, name: pivot, from: [0, -0.02, 0], to: [0, 0.02, 0], first: {{surface: link.x0}}}}
  - {{type: hinge, name: elbow, from: [1, -0.02, 0], to: [1, 0.02, 0], first: {{region: bob}}, second: {{surface: link.x1}}}}
time: {{end: 1}}
integrator: {{{}}}
)",
                     integrator);
}

TEST(Pendulum, OfAFlexibleLinkConvergesWithEveryMethod) {
  const auto places = [](const std::string& integrator) {
    const BuiltTestScene s(pendulum_of_a_link(integrator));
    return s.positions(motion_of(s).last.q);
  };
  const NodalVector reference = places("type: ida_bdf, rtol: 1e-9, max_order: 5");
  const auto error = [&](const std::string& method, double rtol) {
    return (places(fmt::format("type: {}, rtol: {}", method, rtol)) - reference).colwise().norm().maxCoeff();
  };
  EXPECT_LE(error("generalized_alpha", 1e-8), 1e-4);
  for (const char* method : {"ida_bdf", "cvode_bdf", "generalized_alpha", "hht_alpha"}) {
    const double loose = error(method, 1e-4), tight = error(method, 1e-6);
    EXPECT_LE(loose, 0.1) << method;
    EXPECT_LE(tight, 0.2 * loose) << method;
  }
}

TEST(Joints, OtherMethodsAreRefusedByName) {
  for (const char* type : {"cvode_adams", "bathe", "arkode_erk", "arkode_dirk", "energy_momentum"}) {
    const BuiltTestScene s(pendulum(std::string("type: ") + type));
    try {
      s.scene.integrator->make(s.model(), task_of(s.scene, s.built));
      ADD_FAILURE() << type;
    } catch (const ConfigError& e) {
      EXPECT_THAT(e.what(), testing::HasSubstr("use ida_bdf")) << type;
    }
  }
}

TEST(Joints, AutoChoosesByTheTolerance) {
  for (const auto& [options, method] :
       {std::pair("type: auto, rtol: 1e-3", "ida_bdf"), std::pair("type: auto, rtol: 1e-5", "generalized_alpha")}) {
    const BuiltTestScene s(pendulum(options));
    const auto integrator = s.scene.integrator->make(s.model(), task_of(s.scene, s.built));
    EXPECT_THAT(integrator->decisions(), testing::Contains(testing::Pair("method", method)));
  }
}

}  // namespace
}  // namespace orthodyn::joint_motion_test
