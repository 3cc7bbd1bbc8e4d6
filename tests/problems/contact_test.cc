// Motions of bodies that touch: an impact with an exact solution, conservation, equilibrium.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "lib/simulation/output/balance.h"
#include "tests/problems/running.h"

namespace orthodyn::contact_motion_test {
namespace {

struct Motion {
  State last;
  double drift = 0;  // of the energy balance, J
};

Motion motion_of(const BuiltTestScene& s) {
  const auto integrator = s.scene.integrator->make(s.model(), task_of(s.scene, s.built));
  EnergyMeter meter(s.model(), *integrator);
  const Outcome outcome =
      run(s.model(), *integrator, s.built.initial, {s.scene.time.end, {}, false}, {&meter}, {false});
  EXPECT_EQ(outcome.status, Outcome::Status::completed) << outcome.message;
  return {outcome.last, meter.drift()};
}

// The mean velocity of the nodes of a region, each of whose bodies has the same nodes.
double mean_velocity(const BuiltTestScene& s, const State& state, int region) {
  const NodalVector v = s.nodal(state.v);
  double sum = 0, count = 0;
  for (std::size_t cell = 0; cell < s.mesh().cells.size(); ++cell)
    if (s.mesh().region_of[cell] == region)
      for (const int node : s.mesh().cells[cell]) sum += v(0, node), ++count;
  return sum / count;
}

// Two equal bars, of which one hits the other end to end: waves of the stress rho c v/2 run through both, and after
// 2 L/c the first bar rests and the second one has its velocity (Saint-Venant 1867).
TEST(Impact, OfEqualBarsExchangesTheirVelocities) {
  for (const char* type :
       {"cvode_bdf, rtol: 1e-5", "ida_bdf, rtol: 1e-5", "bathe, step: 2e-3", "newmark, step: 1e-3"}) {
    const BuiltTestScene s(fmt::format(R"(
mesh:
  type: bodies
  bodies:
    a: {{mesh: {{type: box, size: [1, 0.1, 0.1], cells: [40, 1, 1], elements: hexahedra, order: 1}}, translation: [-1.001, 0, 0]}}
    b: {{mesh: {{type: box, size: [1, 0.1, 0.1], cells: [40, 1, 1], elements: hexahedra, order: 1}}}}
materials: {{m: {{type: isotropic, density: 1, young: 1, nu: 0}}}}
terms: [{{type: contact, between: [a.x1, b.x0], stiffness: 40, onset: 1e-4}}]
initial: {{velocity_field: ["x < -0.0005 ? 0.01 : 0", 0, 0]}}
time: {{end: 3}}
integrator: {{type: {}}}
)",
                                       type));
    const Motion motion = motion_of(s);
    EXPECT_LE(std::abs(mean_velocity(s, motion.last, 0)), 0.05 * 0.01) << type;
    EXPECT_NEAR(mean_velocity(s, motion.last, 1), 0.01, 0.05 * 0.01) << type;
    const double momentum = s.model().evaluate("momentum.linear", motion.last)[0];
    EXPECT_NEAR(momentum, s.model().evaluate("momentum.linear", s.built.initial)[0], 1e-6 * 0.01) << type;
    EXPECT_LE(std::abs(motion.drift), 5e-3 * s.model().evaluate("energy.kinetic", s.built.initial)[0]) << type;
  }
}

// Two blocks are pressed together by a traction: their surfaces are p/k + w/2 deep in each other.
TEST(Contact, CarriesAUniformPressure) {
  const BuiltTestScene s(R"(
mesh:
  type: bodies
  bodies:
    lower: {mesh: {type: box, size: [1, 1, 0.5], cells: [2, 2, 1], elements: hexahedra, order: 1}}
    upper: {mesh: {type: box, size: [1, 1, 0.5], cells: [2, 2, 1], elements: hexahedra, order: 1}, translation: [0, 0, 0.5]}
materials: {m: {type: isotropic, density: 1, young: 100, nu: 0}}
clamps: [{surface: lower.z0}, {surface: upper.z1, components: [x, y]}]
loads: [{surface: upper.z1, traction: [0, 0, -2], factor: {type: smooth_step, end: 5}}]
damping: {mass: 5}
terms: [{type: contact, between: [lower.z1, upper.z0], stiffness: 400, onset: 1e-3}]
time: {end: 12}
integrator: {type: cvode_bdf, rtol: 1e-6}
)");
  const Motion motion = motion_of(s);
  const NodalVector u = s.nodal(motion.last.q);
  double top = 0;
  for (std::size_t i = 0; i < s.mesh().nodes.size(); ++i)
    if (s.mesh().nodes[i][2] == 1) top = std::min(top, u(2, static_cast<Eigen::Index>(i)));
  EXPECT_NEAR(top, -(2.0 / 100 + 2.0 / 400 + 0.5e-3), 1e-4);
}

// A block that slides farther than `slide` allows, or lies farther at the start.
std::string sliding_block(double slide, const std::string& integrator) {
  return fmt::format(R"(
mesh:
  type: bodies
  bodies:
    lower: {{mesh: {{type: box, size: [1, 0.3, 0.1], cells: [10, 2, 1], elements: hexahedra, order: 1}}}}
    upper: {{mesh: {{type: box, size: [0.25, 0.25, 0.1], cells: [2, 2, 1], elements: hexahedra, order: 1}}, translation: [0.02, 0.03, 0.0999]}}
materials: {{m: {{type: isotropic, density: 1000, young: 1e6, nu: 0.3}}}}
clamps: [{{surface: lower.z0}}]
terms: [{{type: contact, between: [lower.z1, upper.z0], stiffness: 1e7, slide: {}}}]
initial: {{velocity: [1, 0, 0]}}
gravity: [0, 0, -10]
time: {{end: 0.5}}
integrator: {{type: {}}}
)",
                     slide, integrator);
}

TEST(Contact, ASlideThatIsTooSmallIsNamedWithoutOtherAdvice) {
  for (const char* type :
       {"ida_bdf", "cvode_bdf", "generalized_alpha", "generalized_alpha, step: 5e-3", "central_differences"}) {
    const BuiltTestScene s(sliding_block(0.3, type));
    const auto integrator = s.scene.integrator->make(s.model(), task_of(s.scene, s.built));
    const Outcome outcome = run(s.model(), *integrator, s.built.initial, {s.scene.time.end, {}, false}, {}, {false});
    EXPECT_EQ(outcome.status, Outcome::Status::failed) << type;
    EXPECT_THAT(outcome.message, testing::HasSubstr("stopped at t = 0.1")) << type;
    EXPECT_THAT(outcome.message, testing::HasSubstr("terms.0: nodes that are 0.3")) << type;
    EXPECT_THAT(outcome.message, testing::EndsWith("touch, but `slide` is 0.3 m: raise it")) << type;
    EXPECT_THAT(outcome.message, testing::Not(testing::HasSubstr("integrator"))) << type;
  }
}

TEST(Contact, ASlideThatIsTooSmallAtTheStartIsRefused) {
  try {
    set_up(Config::from_text(sliding_block(0.01, "ida_bdf"), "scene.yaml"));
    ADD_FAILURE() << "accepted";
  } catch (const ConfigError& e) {
    EXPECT_THAT(e.what(), testing::StartsWith("scene.yaml:9:"));
    EXPECT_THAT(e.what(), testing::EndsWith("touch, but `slide` is 0.01 m: raise it"));
  }
}

// A block on an inclined plane, which is the ground or the face of a clamped body, with mu below and above the tangent
// tan(a) = 0.5 of its angle: x = g (sin a - mu cos a) t^2/2, and creep at the velocity w with
// w / sqrt(w^2 + c^2) = tan(a)/mu.
TEST(Friction, LetsABlockSlideOrHoldsIt) {
  const std::string ground =
      "mesh: {type: box, size: [0.1, 0.1, 0.05], cells: [2, 2, 1], elements: hexahedra, order: 1}\n"
      "terms: [{type: ground_contact, stiffness: 1e9, onset: 1e-5, creep: 1e-3, friction: ";
  const std::string body =
      "mesh: {type: bodies, bodies: {block: {mesh: {type: box, size: [0.1, 0.1, 0.05], cells: [2, 2, 1], elements: "
      "hexahedra, order: 1}}, slope: {mesh: {type: box, size: [1, 0.3, 0.1], cells: [10, 3, 1], elements: hexahedra, "
      "order: 1}, translation: [-0.1, -0.1, -0.1]}}}\nclamps: [{surface: slope.z0}]\n"
      "terms: [{type: contact, between: [block.z0, slope.z1], stiffness: 1e9, onset: 1e-5, creep: 1e-3, friction: ";
  for (const std::string& scene : {ground, body})
    for (const double mu : {0.2, 1.0}) {
      const double c = 1 / std::sqrt(1.25), s = 0.5 * c, end = 0.4;
      const BuiltTestScene built(scene + fmt::format(R"({}}}]
materials: {{m: {{type: isotropic, density: 1000, young: 1e7, nu: 0}}}}
gravity: [{}, 0, {}]
damping: {{stiffness: 1e-4}}
time: {{end: {}}}
integrator: {{type: cvode_bdf, rtol: 1e-5}}
)",
                                                     mu, 10 * s, -10 * c, end));
      const Motion motion = motion_of(built);
      const NodalVector u = built.nodal(motion.last.q);
      const double way = u.row(0).head(18).mean();  // of the nodes of the block
      const double slides = 10 * (s - mu * c) * end * end / 2, creeps = 1e-3 * end * 0.5 / std::sqrt(mu * mu - 0.25);
      if (mu < 0.5) EXPECT_NEAR(way, slides, 0.02 * slides) << scene;
      else EXPECT_NEAR(way, creeps, 0.2 * creeps) << scene;  // and slides until it is pressed
    }
}

// Two soft blocks collide off their centres in flight: momentum and energy.
TEST(Impact, KeepsMomentumAndEnergy) {
  const BuiltTestScene s(R"(
mesh:
  type: bodies
  bodies:
    a: {mesh: {type: box, size: [0.4, 0.4, 0.4], cells: [2, 2, 2], order: 1}, axis: [1, 2, 0.5], angle: 0.4 rad}
    b: {mesh: {type: box, size: [0.4, 0.4, 0.4], cells: [2, 2, 2], order: 1}, translation: [0.2, 0.1, 0.75]}
materials: {m: {type: orthotropic_stable, density: 10, young: [4e3, 1e3, 2e3], nu: 0.3}}
terms: [{type: contact, between: [a, b], stiffness: 2e4}]
initial: {velocity_field: [0, 0, "z > 0.6 ? -2 : 0"]}
time: {end: 0.4}
integrator: {type: cvode_bdf, rtol: 1e-6}
)");
  const Motion motion = motion_of(s);
  const State& start = s.built.initial;
  for (const char* kind : {"momentum.linear", "momentum.angular"}) {
    const auto before = s.model().evaluate(kind, start), after = s.model().evaluate(kind, motion.last);
    for (std::size_t c = 0; c < 3; ++c) EXPECT_NEAR(after[c], before[c], 1e-3 * std::abs(before[2]) + 1e-4) << kind;
  }
  EXPECT_LE(std::abs(motion.drift), 1e-2 * s.model().evaluate("energy.kinetic", start)[0]);
  EXPECT_GE(std::abs(s.model().evaluate("momentum.linear", start)[2]), 1);
}

}  // namespace
}  // namespace orthodyn::contact_motion_test
