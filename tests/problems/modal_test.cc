// Modal integration of bodies: against all modes, against statics, and its report on omitted modes.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstdlib>
#include <memory>
#include <string>
#include <vector>

#include "lib/config/registry.h"
#include "lib/linear/solver.h"
#include "lib/simulation/error_estimate/modal_solution.h"
#include "lib/simulation/output/balance.h"
#include "lib/study/quantities/verify.h"
#include "tests/problems/running.h"

namespace orthodyn::modal_test {
namespace {

// A linear cantilever with 360 unknowns and oblique grain: 51 Hz.
BuiltTestScene beam(const std::string& rest) {
  return BuiltTestScene(R"(
mesh: {type: box, size: [1, 0.1, 0.1], cells: [13, 2, 2], order: 1}
materials: {m: {type: orthotropic_stable, density: 500, young: [1e9, 1e8, 5e7], nu: 0.3}}
regions: {all: {material: m, axes: )" +
                        kTurnedAxes + "}}\nelasticity: {kinematics: linear}\n" + rest);
}

std::unique_ptr<Integrator> made(const BuiltTestScene& s, const std::string& options) {
  const auto choice = Registry<IntegratorChoice>::read(Config::from_text("{" + options + "}"));
  return choice->make(s.model(), task_of(s.scene, s.built));
}

// Output times, denser at the start, including the end.
std::vector<State> states(const BuiltTestScene& s, Integrator& integrator, int count) {
  std::vector<State> out;
  Plan plan{.end = s.scene.time.end, .output_times = evenly_spaced(0, 1, count)};
  for (double& t : plan.output_times) t *= t * t * plan.end;
  Watch watch([&](const State& state) { out.push_back(state); });
  const std::atomic<bool> interrupt = false;
  const Outcome outcome = run(s.model(), integrator, s.built.initial, plan, {&watch}, interrupt);
  EXPECT_EQ(outcome.status, Outcome::Status::completed) << outcome.message;
  return out;
}

double mass_norm(const BuiltTestScene& s, const Vector& q) {
  Vector Mq(q.size());
  s.model().multiply_mass(q, Mq);
  return std::sqrt(q.dot(Mq));
}

// Uses another eigenvalue solver and other formulas.
TEST(Modal, WithAllModesIsTheExactSolution) {
  for (const std::string more : {"clamps: [{surface: x0}]\ngravity: [0, 0, -4]\ntime: {end: 0.3}\n",
                                 "clamps: [{surface: x0}]\ngravity: [0, 0, -4]\ndamping: {stiffness: 1e-3, mass: 2}\n"
                                 "mass: consistent\ntime: {end: 0.3}\n",
                                 "initial: {spin: [0, 0, 0.3], velocity: [0.1, 0, 0.2]}\ngravity: [0, 0, -4]\n"
                                 "damping: {stiffness: 1e-4}\ntime: {end: 0.3}\n"}) {
    const auto scene = beam(more);
    const auto exact = ModalSolution::find(scene.model(), scene.built.initial);
    ASSERT_TRUE(exact.has_value());
    const auto integrator = made(scene, "type: modal, modes: 10000");
    double motion = 0, speed = 0, error = 0, error_of_speed = 0;
    for (const State& state : states(scene, *integrator, 30)) {
      const State expected = exact->at(state.t);
      motion = std::max(motion, expected.q.lpNorm<Eigen::Infinity>());
      speed = std::max(speed, expected.v.lpNorm<Eigen::Infinity>());
      error = std::max(error, (state.q - expected.q).lpNorm<Eigen::Infinity>());
      error_of_speed = std::max(error_of_speed, (state.v - expected.v).lpNorm<Eigen::Infinity>());
    }
    EXPECT_LE(error, 1e-9 * motion) << more;
    EXPECT_LE(error_of_speed, 1e-9 * speed) << more;
    EXPECT_EQ(integrator->statistics().steps, 1) << more;
  }
}

Vector static_deflection(const BuiltTestScene& s, const Vector& load) {
  Linearization at;
  s.model().linearize(0, s.zero(), s.zero(), TangentKind::exact, at);
  const auto solver = make_linear_solver("cholesky");
  solver->analyze(s.model().pattern());
  EXPECT_EQ(solver->factor(at.stiffness.data()), FactorStatus::ok);
  Vector u(load.size());
  solver->solve(load, u);
  return u;
}

// A point load that grows over 100 periods of the first mode. The modes alone miss the local deformation under the
// load.
TEST(Modal, EndsAtTheStaticDeflectionOfALoadThatGrowsSlowly) {
  const auto scene = beam(
      "clamps: [{surface: x0}]\nterms: [{type: point_load, nearest: [1, 0, 0], force: [0, 30, 100], factor: {type: "
      "smooth_step, end: 4}}]\ntime: {end: 4}\n");
  const auto integrator = made(scene, "type: modal, modes: 5, rtol: 1e-8");
  const State last = states(scene, *integrator, 20).back();
  const Vector u = static_deflection(scene, scene.force(scene.zero(), scene.zero(), 4));
  EXPECT_LE((last.q - u).norm(), 1e-6 * u.norm());
  // The part represented by five modes.
  const Eigen::MatrixXd M = scene.mass(), K = scene.stiffness(scene.zero());
  const Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::MatrixXd> modes(K, M);
  const Eigen::MatrixXd phi = modes.eigenvectors().leftCols(5);
  EXPECT_GE((phi * (phi.transpose() * (M * u)) - u).norm(), 1e-3 * u.norm());
}

// A free body: the static correction deforms it although it is not supported.
TEST(Modal, DeformsAFreeBodyUnderASlowLoad) {
  const auto scene = beam(
      "loads: [{surface: x1, force: [100, 0, 0], factor: {type: smooth_step, end: 2}}, {surface: x0, force: [-100, 0, "
      "0], factor: {type: smooth_step, end: 2}}]\ntime: {end: 2}\n");
  const auto few = made(scene, "type: modal, modes: 8, rtol: 1e-8");
  const auto all = made(scene, "type: modal, modes: 10000, rtol: 1e-8");
  const State a = states(scene, *few, 10).back(), b = states(scene, *all, 10).back();
  EXPECT_LE((a.q - b.q).norm(), 1e-4 * b.q.norm());
  const auto elastic = [&](const State& s) { return scene.model().evaluate("energy.elastic", s)[0]; };
  EXPECT_NEAR(elastic(a), elastic(b), 1e-4 * elastic(b));
}

double told(const Integrator& integrator) {
  for (const auto& [key, value] : integrator.decisions()) {
    const auto at = value.find("about ");
    if (key == "kept" && at != std::string::npos) return std::strtod(value.c_str() + at + 6, nullptr);
  }
  return 0;
}

// Largest difference in the mass norm, relative to the largest motion.
double left_out(const BuiltTestScene& scene, Integrator& few) {
  const auto all = made(scene, "type: modal, modes: 10000, rtol: 1e-8");
  const auto got = states(scene, few, 400), expected = states(scene, *all, 400);
  double error = 0, motion = 0;
  for (std::size_t k = 1; k < got.size(); ++k) {
    error = std::max(error, mass_norm(scene, got[k].q - expected[k].q));
    motion = std::max(motion, mass_norm(scene, expected[k].q));
  }
  return error / motion;
}

// Suddenly loaded; with an initial velocity; with moving supports; with a load that has kinks.
TEST(Modal, TellsWhatItLeavesOutWithinAFactorOfThree) {
  for (const std::string more : {"gravity: [0, 0, -4]\n", "gravity: [0, 0, -4]\ndamping: {stiffness: 1e-4}\n",
                                 "initial: {velocity_field: [0, 0, \"x^4\"]}\n",
                                 "loads: [{surface: x1, force: [0, 0, 10], factor: {type: sine, frequency: 20 Hz}}]\n",
                                 "loads: [{surface: x1, force: [0, 20, 10], factor: {type: ramp, end: 0.05}}]\n",
                                 "loads: [{surface: z1, force: [0, 20, 10], factor: {type: sine, frequency: 20 "
                                 "Hz}}]\ndamping: {stiffness: 1e-4}\n"}) {
    const auto scene = beam(more + "clamps: [{surface: x0}]\ntime: {end: 0.3}\n");
    for (const int modes : {6, 20}) {
      const auto few = made(scene, fmt::format("type: modal, modes: {}, rtol: 1e-8", modes));
      const double measured = left_out(scene, *few), said = told(*few);
      EXPECT_GE(said, measured / 3) << more << modes;
      EXPECT_LE(said, 3 * measured) << more << modes;
    }
  }
}

// A single step covers sixteen periods of the first mode.
TEST(Modal, BalancesTheEnergyOverAStepOfManyPeriods) {
  const auto scene = beam("clamps: [{surface: x0}]\ngravity: [0, 0, -4]\ndamping: {stiffness: 1e-4}\ntime: {end: 1}\n");
  const auto integrator = made(scene, "type: modal, modes: 20");
  EnergyMeter energy(scene.model(), *integrator, EnergyTimes::outputs);
  run(scene.model(), *integrator, scene.built.initial, {1, {0.5, 1.0}}, {&energy}, {false});
  EXPECT_EQ(integrator->statistics().steps, 1);
  EXPECT_GT(energy.last().dissipated, 0.2 * energy.scale());
  EXPECT_LE(energy.drift(), 1e-2 * energy.scale());
}

// The tip passes its mean twice a period.
TEST(Modal, FindsAllEventsInAStepOfManyPeriods) {
  const auto scene = beam("clamps: [{surface: x0}]\ninitial: {velocity_field: [0, 0, \"x^2\"]}\ntime: {end: 1}\n");
  const auto integrator = made(scene, "type: modal, modes: 20");
  const Vector tip = scene.dofs([](const Vec3& X) { return Vec3(0, 0, X == Vec3(1, 0, 0) ? 1 : 0); });
  EventFinder finder({{.name = "middle", .quantity = [&](const ObservedState& o) { return tip.dot(o.state().q); }}});
  struct Count : Observer {
    void on_event(const Crossing&) override { ++events; }
    int events = 0;
  } count;
  Plan plan{.end = 1};
  plan.events = &finder;
  run(scene.model(), *integrator, scene.built.initial, plan, {&count}, {false});
  EXPECT_EQ(integrator->statistics().steps, 1);
  int changes = 0;
  State state;
  bool below = false;
  for (int k = 1; k <= 10'000; ++k) {
    integrator->interpolate(1e-4 * k, state);
    if (const bool now = tip.dot(state.q) < 0; now != below) ++changes, below = now;
  }
  EXPECT_GT(changes, 20);
  EXPECT_EQ(count.events, changes);
}

// Cases with known values that use states within steps: moved supports, reactions, maxima, frequencies, energies.
TEST(Modal, MeetsTheExpectationsOfLinearCases) {
  for (const std::string name :
       {"base_excited_oscillator", "base_excited_consistent", "bar_ramp_load", "bar_step_load", "bar_frequency_lumped",
        "bar_frequency_consistent", "one_node_harmonic_load", "reaction_of_a_shelf", "point_load", "confined_creep",
        "falling_with_drag", "hydrostatic_pressure", "spring_and_mass"}) {
    Config config = Config::from_file(ORTHODYN_SOURCE_DIR "/configs/cases/" + name + ".yaml");
    config.set_yaml("integrator", "{type: modal, modes: 100000, rtol: 1e-6}");
    config.set_yaml("elasticity.kinematics", "linear");
    const study::CaseResult result = study::verify(config);
    EXPECT_EQ(result.outcome.message, "") << name;
    for (const auto& check : result.checks)
      EXPECT_TRUE(check.passed()) << name << ": " << check.expectation.title() << ": computed " << check.computed
                                  << ", expected " << check.expectation.value;
  }
}

std::string refusal(const std::string& more, const std::string& integrator) {
  try {
    const auto scene = beam(more + "time: {end: 0.3}\n");
    made(scene, integrator);
  } catch (const ConfigError& e) {
    return e.what();
  }
  return "";
}

TEST(Modal, RefusesDampingThatDiffersAmongRegionsAndTellsTheRemedy) {
  const BuiltTestScene scene(R"(
mesh: {type: box, size: [1, 0.1, 0.1], cells: [4, 1, 1], parts: {tip: {min: [0.5, 0, 0], max: [1, 1, 1]}}, order: 1}
materials: {m: {type: orthotropic_stable, density: 500, young: [1e9, 1e8, 5e7], nu: 0.3}}
regions: {tip: {material: m, stiffness_damping: 1e-3}, body: {material: m}}
elasticity: {kinematics: linear}
clamps: [{surface: x0}]
time: {end: 0.3}
)");
  try {
    made(scene, "type: modal, modes: 5");
    FAIL() << "accepted";
  } catch (const ConfigError& e) {
    EXPECT_NE(std::string(e.what()).find("damping that differs among regions"), std::string::npos) << e.what();
    EXPECT_NE(std::string(e.what()).find("Give all regions the same stiffness damping"), std::string::npos);
  }
}

TEST(Modal, RefusesDashpotsGroundAndTooFewModesForAStart) {
  const auto expect = [](const std::string& message, const std::string& part) {
    EXPECT_NE(message.find(part), std::string::npos) << message;
  };
  const std::string clamp = "clamps: [{surface: x0}]\n";
  expect(refusal(clamp + "terms: [{type: dashpot, nearest: [1, 0, 0], coefficient: 30}]\n", "type: modal, modes: 5"),
         "dashpots couples them");
  expect(refusal(clamp + "terms: [{type: ground_contact, point: [0, 0, -1], normal: [0, 0, 1], stiffness: 1e6}]\n",
                 "type: modal, modes: 5"),
         "use no contact");
  expect(refusal("", "type: modal, modes: 5"), "a free body has 6");
  expect(refusal(clamp + "initial: {velocity_field: [0, 0, \"x > 0.9 ? 1 : 0\"]}\n", "type: modal, modes: 1"),
         "keep more modes");
}

}  // namespace
}  // namespace orthodyn::modal_test
