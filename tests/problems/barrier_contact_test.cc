// Motions with contact by a barrier, and bodies that must not pass through each other.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>

#include "lib/fem/contact/near_features.h"
#include "tests/problems/running.h"

namespace orthodyn::barrier_motion_test {
namespace {

constexpr int kFrames = 20;

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
    const Outcome outcome = run_scene(s, kFrames, [&](const State& state) {
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

// A block flies over 40 times its size, where steps are long because nothing happens, and bounces off a thin plate.
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
      const Outcome outcome = run_scene(s, kFrames, [&](const State& state) {
        const NodalVector x = s.positions(state.q);
        lowest = std::min(lowest, x.row(2).tail(8).mean() - x.row(2).head(98).minCoeff());
      });
      ASSERT_EQ(outcome.status, Outcome::Status::completed) << law << type << outcome.message;
      EXPECT_GT(lowest, 0) << law << ", " << type;
    }
}

// Two sheets whose cells are 25 times as wide as the sheets are thick.
TEST(BarrierContact, StopsThinSheetsOfWideCells) {
  for (const char* type : {"cvode_bdf", "generalized_alpha"}) {
    const BuiltTestScene s(fmt::format(R"(
mesh:
  type: bodies
  bodies:
    low: {{mesh: {{type: box, size: [0.2, 0.2, 0.002], cells: [4, 4, 1], elements: hexahedra, order: 1}}, translation: [-0.1, -0.1, 0]}}
    high: {{mesh: {{type: box, size: [0.17, 0.17, 0.002], cells: [4, 4, 1], elements: hexahedra, order: 1}}, translation: [-0.08, -0.09, 0.05]}}
materials: {{m: {{type: orthotropic_stable, density: 700, young: [1e8, 5e7, 5e7], nu: 0.3}}}}
terms: [{{between: [low, high], stiffness: 1e10, type: barrier_contact, gap: 5e-4}}]
damping: {{stiffness: 1e-4}}
initial: {{velocity_field: ["0", "0", "z > 0.02 ? -20 : 0"]}}
time: {{end: 0.006}}
integrator: {{type: {}, rtol: 1e-3}}
)",
                                       type));
    State last;
    const Outcome outcome = run_scene(s, kFrames, [&](const State& state) { last = state; });
    ASSERT_EQ(outcome.status, Outcome::Status::completed) << type << outcome.message;
    const NodalVector x = s.positions(last.q);
    EXPECT_GT(x.row(2).tail(50).mean(), x.row(2).head(50).mean()) << type;
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
  EXPECT_LE(*outcome.may_pass_through, 5e-3);  // the bodies are 0.1 m apart
}

// A ring buckles under the outer pressure p = 3 EI/R^3. Its opposite sides touch at 1.75 p (Flaherty, Keller & Rubinow
// 1972). Here the pressure is 2.8 p, and the barrier keeps the sides apart.
TEST(BarrierContact, KeepsACollapsedRingFromCrossingItself) {
  const BuiltTestScene s(R"(
mesh: {type: tube, radius: 0.05, inner_radius: 0.046, length: 0.01, cells: [32, 1, 1], order: 2}
materials: {rubber: {type: isotropic, density: 1000, young: 1e6, nu: 0}}
clamps: [{surface: end0, components: [z]}, {surface: end1, components: [z]}]
terms:
  - {type: pressure, surface: outer, pressure: 400, factor: {type: smooth_step, end: 0.5}}
  - {type: barrier_contact, between: [inner, inner], stiffness: 1e7, gap: 1e-3}
damping: {mass: 10, stiffness: 1e-3}
initial: {noise: {amplitude: 1e-5, seed: 1}}
time: {end: 1.2}
integrator: {type: cvode_bdf, rtol: 1e-4}
)");
  const ContactSurface inner(s.mesh(), s.mesh().surfaces.at("inner"));
  State last;
  const Outcome outcome = run_scene(s, 10, [&](const State& state) { last = state; });
  ASSERT_EQ(outcome.status, Outcome::Status::completed) << outcome.message;
  NodalVector storage;
  const NodalVector& x = inner.middles().values(s.positions(last.q), storage);
  const std::vector<NearPlace> places = NearFeatures(inner, inner, 1e-3).at(x);  // throws if crossed
  EXPECT_FALSE(places.empty());
  EXPECT_LE(s.scalar("energy.kinetic", last.q, last.v), 1e-3 * s.scalar("energy.elastic", last.q, last.v));
}

}  // namespace
}  // namespace orthodyn::barrier_motion_test
