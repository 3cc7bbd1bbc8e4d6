// Runs of linear scenes with the modes that `auto` takes, against one with all modes, which is exact in time; and the faster way that
// `orthodyn check` tells of.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <optional>

#include "lib/simulation/errors/error_norms.h"
#include "lib/simulation/faster.h"
#include "lib/simulation/run.h"
#include "lib/simulation/setup.h"

namespace orthodyn::modes_by_auto_test {
namespace {

std::string beam(const std::string& rest, const std::string& kinematics = "linear") {
  return "mesh: {type: box, size: [1, 0.1, 0.1], cells: [10, 1, 1]}\n"
         "materials: {m: {type: preset, name: sitka_spruce}}\n"
         "clamps: [{surface: x0}]\nelasticity: {kinematics: " + kinematics + "}\n" + rest + "\n";
}

const std::string kTapped = "terms: [{type: point_load, nearest: [1, 0, 0.1], force: [0, 0, -2], factor: {type: "
                            "expression, formula: \"t < 2e-3 ? sin(pi*t/2e-3) : 0\", kinks: [2 ms], peak: 1}}]\n"
                            "time: {end: 1}";
const std::string kStep = "loads: [{surface: x1, force: [0, 0, -10]}]\ntime: {end: 0.1}";
const std::string kShaken = "loads: [{surface: x1, force: [0, 0, -10], factor: {type: sine, frequency: 90 Hz}}]\n"
                            "damping: {mass: 10, stiffness: 1e-5}\ntime: {end: 0.1}";
Setup set_up_with(const std::string& scene, const std::string& integrator) {
  return set_up(Config::from_text(scene + "\nintegrator: {" + integrator + "}\n"));
}

Trajectory trajectory(const Setup& setup) {
  constexpr int kOutputs = 200;
  const std::atomic<bool> never{false};
  const auto& time = setup.scene.time;
  TrajectoryRecorder recorder(kOutputs);
  const Outcome outcome =
      run(*setup.built.model, *setup.integrator, setup.built.initial,
          {.end = time.end, .output_times = evenly_spaced(time.start, time.end, kOutputs)}, {&recorder}, never);
  EXPECT_EQ(outcome.status, Outcome::Status::completed);
  return recorder.trajectory();
}

std::string decision(const Setup& setup, const std::string& wanted) {
  for (const auto& [key, value] : setup.integrator->decisions())
    if (key == wanted) return value;
  return "";
}

class ModesByAuto : public testing::TestWithParam<std::pair<const char*, std::string>> {};
INSTANTIATE_TEST_SUITE_P(Scenes, ModesByAuto,
                         testing::Values(std::pair{"tapped", kTapped}, std::pair{"step", kStep},
                                         std::pair{"shaken", kShaken}),
                         [](const auto& one) { return one.param.first; });

TEST_P(ModesByAuto, AreWithinTheToleranceOfTheMotion) {
  const std::string scene = beam(GetParam().second);
  const orthodyn::Setup exact = set_up_with(scene, "type: modal, modes: 10000");
  const ReferenceNorms reference(*exact.built.model, trajectory(exact), {});
  int taken = 0;
  for (const double rtol : {1e-2, 1e-3}) {
    const orthodyn::Setup setup = set_up_with(scene, fmt::format("type: auto, rtol: {}", rtol));
    if (decision(setup, "method") != "modal") continue;  // many modes, or few steps
    ++taken;
    const auto errors = reference.errors(trajectory(setup));
    EXPECT_LT(errors.displacement.max, 2 * rtol) << decision(setup, "because");
    EXPECT_LT(errors.velocity.max, 20 * rtol) << decision(setup, "because");
  }
  EXPECT_GT(taken, 0);
}

// A spruce board on two lines, tapped in its middle.
std::string board(double force, const std::string& kinematics) {
  return fmt::format(R"(
mesh: {{type: box, size: [0.4, 0.06, 0.004], cells: [12, 2, 1]}}
materials: {{s: {{type: preset, name: sitka_spruce}}}}
elasticity: {{kinematics: {}}}
damping: {{mass: 4, stiffness: 1e-6}}
clamps:
  - {{box: {{min: [0.066, 0, 0], max: [0.067, 0.06, 0]}}}}
  - {{box: {{min: [0.333, 0, 0], max: [0.334, 0.06, 0]}}, components: [z]}}
terms:
  - {{type: point_load, nearest: [0.2, 0.03, 0.004], force: [0, 0, -{}],
      factor: {{type: expression, formula: "t < 2e-3 ? sin(pi*t/2e-3) : 0", kinks: [2 ms], peak: 1}}}}
time: {{end: 0.25}}
integrator: {{type: arkode_dirk, rtol: 1e-4}}
)", kinematics, force);
}

std::optional<FasterWay> faster_way_of(const std::string& scene) {
  const orthodyn::Setup setup = set_up(Config::from_text(scene));
  setup.integrator->start(setup.built.initial);
  return faster_way(setup, run_cost(setup, term_costs(*setup.built.model, setup.built.initial, 0.05)));
}

TEST(FasterWay, IsToldWhereLinearKinematicsAreAccurateAndModesServe) {
  const auto way = faster_way_of(board(2, "corotational"));
  ASSERT_TRUE(way);
  EXPECT_EQ(way->changes, (std::vector<std::string>{"elasticity.kinematics: linear", "integrator.type: auto"}));
  EXPECT_TRUE(way->method.starts_with("modal, ")) << way->method;
  ASSERT_TRUE(way->error);
  EXPECT_GT(*way->error, 0);
}

TEST(FasterWay, IsTheMethodAloneWhereKinematicsAreLinear) {
  const auto way = faster_way_of(board(2, "linear"));
  ASSERT_TRUE(way);
  EXPECT_EQ(way->changes, std::vector<std::string>{"integrator.type: auto"});
  EXPECT_FALSE(way->error);
}

TEST(FasterWay, IsNoneOfLargeDeflections) { EXPECT_FALSE(faster_way_of(board(200, "corotational"))); }

}  // namespace
}  // namespace orthodyn::modes_by_auto_test
