// Motions with contact by a barrier, and bodies that must not pass through each other.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>

#include "tests/problems/running.h"

namespace orthodyn::barrier_motion_test {
namespace {

constexpr double kFrames = 20;

// Two bars whose long edges face each other collide crosswise, between their nodes. The momentum is exchanged, the
// energy kept.
TEST(BarrierContact, SeesEdgesThatCollideBetweenNodes) {
  for (const char* type : {"cvode_bdf", "ida_bdf", "generalized_alpha", "arkode_dirk"}) {
    const BuiltTestScene s(fmt::format(R"(
mesh:
  type: bodies
  bodies:
    low: {{mesh: {{type: box, size: [0.2, 0.02, 0.02], cells: [4, 1, 1], elements: hexahedra, order: 1, origin: [-0.1, -0.01, -0.01]}}, axis: [1, 0, 0], angle: 45 deg}}
    high: {{mesh: {{type: box, size: [0.02, 0.2, 0.02], cells: [1, 4, 1], elements: hexahedra, order: 1, origin: [-0.01, -0.1, -0.01]}}, axis: [0, 1, 0], angle: 45 deg, translation: [0.013, 0.011, 0.04]}}
materials: {{m: {{type: orthotropic_stable, density: 700, young: [1e8, 5e7, 5e7], nu: 0.3}}}}
terms: [{{type: barrier_contact, between: [low, high], stiffness: 1e10}}]
initial: {{velocity_field: ["0", "0", "z > 0.02 ? -1 : 0"]}}
time: {{end: 0.05}}
integrator: {{type: {}, rtol: 1e-4}}
)",
                                       type));
    const double energy = total_energy(s, s.built.initial);
    const Vec3 before = momentum(s, "linear", s.built.initial);
    double gained = 0;
    State last;
    const Outcome outcome = run_scene(s, static_cast<int>(kFrames), [&](const State& state) {
      gained = std::max(gained, total_energy(s, state) - energy);
      last = state;
    });
    ASSERT_EQ(outcome.status, Outcome::Status::completed) << type << ": " << outcome.message;
    EXPECT_LE(gained, 1e-2 * energy) << type;
    EXPECT_LE((momentum(s, "linear", last) - before).norm(), 1e-3 * before.norm()) << type;
    const NodalVector u = s.nodal(last.q);
    EXPECT_LT(u.row(2).head(20).mean(), -0.005) << type;  // the lower bar was pushed down
  }
}

// A block flies 40 times its size within the time, towards a plate as thick as half of one of its nodes' ways in a free
// step, and bounces off it.
TEST(Contact, StopsAFastBodyAtAThinPlate) {
  for (const char* law : {"contact, reach: 0.0009", "barrier_contact"})
    for (const char* type : {"cvode_bdf", "ida_bdf", "generalized_alpha", "arkode_erk"}) {
      const BuiltTestScene s(fmt::format(R"(
mesh:
  type: bodies
  bodies:
    plate: {{mesh: {{type: box, size: [0.2, 0.2, 0.002], cells: [6, 6, 1], elements: hexahedra, order: 1}}, translation: [-0.1, -0.1, 0]}}
    ball: {{mesh: {{type: box, size: [0.02, 0.02, 0.02], cells: [1, 1, 1], elements: hexahedra, order: 1}}, translation: [-0.012, -0.013, 0.8]}}
materials: {{m: {{type: orthotropic_stable, density: 700, young: [1e8, 5e7, 5e7], nu: 0.3}}}}
terms: [{{between: [plate, ball], stiffness: 1e10, type: {}}}]
initial: {{velocity_field: ["0", "0", "z > 0.5 ? -20 : 0"]}}
time: {{end: 0.06}}
integrator: {{type: {}, rtol: 1e-3}}
)",
                                         law, type));
      double lowest = 1;
      const Outcome outcome = run_scene(s, static_cast<int>(kFrames), [&](const State& state) {
        const NodalVector x = s.positions(state.q);
        lowest = std::min(lowest, x.row(2).tail(8).mean() - x.row(2).head(98).minCoeff());
      });
      ASSERT_EQ(outcome.status, Outcome::Status::completed) << law << type << outcome.message;
      EXPECT_GT(lowest, 0) << law << ", " << type;
    }
}

TEST(Contact, TellsOfFixedStepsThatMayMissIt) {
  const BuiltTestScene s(R"(
mesh:
  type: bodies
  bodies:
    plate: {mesh: {type: box, size: [0.2, 0.2, 0.002], cells: [1, 1, 1], order: 1}, translation: [-0.1, -0.1, 0]}
    ball: {mesh: {type: box, size: [0.02, 0.02, 0.02], cells: [1, 1, 1], order: 1}, translation: [-0.012, -0.013, 0.1]}
materials: {m: {type: orthotropic_stable, density: 700, young: [1e8, 5e7, 5e7], nu: 0.3}}
terms: [{type: contact, between: [plate, ball], stiffness: 1e10, reach: 0.0009}]
initial: {velocity_field: ["0", "0", "z > 0.05 ? -20 : 0"]}
time: {end: 0.01}
integrator: {type: newmark, step: 1e-3}
)");
  const Outcome outcome = run_scene(s, 1, [](const State&) {});
  ASSERT_TRUE(outcome.may_pass_through);
  EXPECT_GT(*outcome.may_pass_through, 1e-3);
  EXPECT_LT(*outcome.may_pass_through, 5e-3);  // the bodies are 0.1 m apart
}

// A strip that is bent onto itself by its ends keeps its layers apart.
TEST(BarrierContact, KeepsAFoldedStripFromCrossingItself) {
  const BuiltTestScene s(R"(
mesh: {type: box, size: [0.2, 0.02, 0.004], cells: [24, 2, 1], elements: hexahedra, order: 1}
materials: {m: {type: isotropic, density: 1000, young: 1e6, nu: 0.3}}
clamps: [{surface: x0}]
motions: [{surface: x1, axis: [0, 1, 0], center: [0.1, 0, 0.002], angle: 0, translation: [-0.19, 0, 0.012], factor: {type: smooth_step, end: 0.5}}]
terms: [{type: barrier_contact, between: [body, body], stiffness: 1e8, gap: 1e-3}]
damping: {mass: 20, stiffness: 1e-3}
time: {end: 0.8}
integrator: {type: cvode_bdf, rtol: 1e-4}
)");
  const Outcome outcome = run_scene(s, static_cast<int>(kFrames), [](const State&) {});
  EXPECT_EQ(outcome.status, Outcome::Status::completed) << outcome.message;
}

}  // namespace
}  // namespace orthodyn::barrier_motion_test
