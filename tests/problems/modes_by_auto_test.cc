// Linear scenes with the modes chosen by `auto`, against all modes, which are exact in time; and the faster method that
// `orthodyn check` suggests.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <optional>

#include "lib/simulation/error_estimate/error_norms.h"
#include "lib/simulation/error_estimate/recorders.h"
#include "lib/simulation/preflight/faster_setup.h"
#include "lib/simulation/run/run.h"
#include "lib/simulation/run/setup.h"

namespace orthodyn::modes_by_auto_test {
namespace {

std::string beam(const std::string& rest, const std::string& kinematics = "linear") {
  return "mesh: {type: box, size: [1, 0.1, 0.1], cells: [10, 1, 1]}\n"
         "materials: {m: {type: preset, name: sitka_spruce}}\n"
         "clamps: [{surface: x0}]\nelasticity: {kinematics: " +
         kinematics + "}\n" + rest + "\n";
}

const std::string kTapped =
    "terms: [{type: point_load, nearest: [1, 0, 0.1], force: [0, 0, -2], factor: {type: expression, formula: \"t < "
    "2e-3 ? sin(pi*t/2e-3) : 0\", kinks: [2 ms], peak: 1}}]\n"
    "time: {end: 1}";
const std::string kStep = "loads: [{surface: x1, force: [0, 0, -10]}]\ntime: {end: 1}";
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

struct Motion {
  std::string name, scene;
  double rtol;
};

class LinearMotion : public testing::TestWithParam<Motion> {};
INSTANTIATE_TEST_SUITE_P(Scenes, LinearMotion,
                         testing::Values(Motion{"tapped_1e2", kTapped, 1e-2}, Motion{"tapped_1e3", kTapped, 1e-3},
                                         Motion{"step_1e2", kStep, 1e-2}),
                         [](const auto& one) { return one.param.name; });

TEST_P(LinearMotion, IsThatOfAllModesWithinTheTolerance) {
  const auto& [name, motion, rtol] = GetParam();
  const std::string scene = beam(motion);
  const orthodyn::Setup exact = set_up_with(scene, "type: modal, modes: 10000");
  const orthodyn::Setup chosen = set_up_with(scene, fmt::format("type: auto, rtol: {}", rtol));
  ASSERT_EQ(decision(chosen, "method"), "modal");
  const auto errors = ReferenceNorms(*exact.built.model, trajectory(exact), {}).errors(trajectory(chosen));
  EXPECT_LT(errors.displacement.max, 2 * rtol) << decision(chosen, "because");
  EXPECT_LT(errors.velocity.max, 20 * rtol) << decision(chosen, "because");
}

// A pulse of a thousandth of the time, long after the start; evenly spaced samples of the load would miss it.
TEST(ModesByAuto, FollowAShortPulseLate) {
  const std::string scene = beam(
      "loads: [{surface: x1, force: [0, 0, -10], factor: {type: expression, formula: \"t > 0.6 && t < 0.601 ? "
      "sin(pi*(t-0.6)/1e-3) : 0\", kinks: [0.6, 0.601]}}]\ntime: {end: 1}");
  const orthodyn::Setup exact = set_up_with(scene, "type: modal, modes: 10000");
  const orthodyn::Setup chosen = set_up_with(scene, "type: auto, rtol: 1e-3");
  EXPECT_EQ(decision(chosen, "method"), "modal");
  const auto errors = ReferenceNorms(*exact.built.model, trajectory(exact), {}).errors(trajectory(chosen));
  EXPECT_LT(errors.displacement.max, 2e-3) << decision(chosen, "because");
}

// A spruce board supported along two lines, struck in the middle.
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
)",
                     kinematics, force);
}

std::optional<FasterSetup> faster_way_of(const std::string& scene) {
  const orthodyn::Setup setup = set_up(Config::from_text(scene));
  setup.integrator->start(setup.built.initial);
  return faster_setup(setup, run_cost(setup, term_costs(*setup.built.model, setup.built.initial, 0.05)));
}

TEST(FasterSetup, IsLinearKinematicsAndModesOfSmallVibrations) {
  const auto way = faster_way_of(board(2, "corotational"));
  ASSERT_TRUE(way);
  EXPECT_EQ(way->changes,
            (std::vector<std::string>{"elasticity.kinematics: linear", "integrator: {type: auto, rtol: 0.0001}"}));
  EXPECT_TRUE(way->method.starts_with("modal, ")) << way->method;
}

TEST(FasterSetup, IsTheMethodAloneWhereKinematicsAreLinear) {
  const auto way = faster_way_of(board(2, "linear"));
  ASSERT_TRUE(way);
  EXPECT_EQ(way->changes, std::vector<std::string>{"integrator: {type: auto, rtol: 0.0001}"});
  EXPECT_FALSE(way->error);
}

// Geometric stiffness makes the error of a shallow deflection grow with its square.
TEST(FasterSetup, TellsAnErrorThatGrowsWithTheSquareOfTheLoad) {
  const auto error = [](double force) { return *faster_way_of(board(force, "corotational"))->error; };
  const double ratio = error(2) / error(0.2);
  EXPECT_GT(ratio, 10);
  EXPECT_LT(ratio, 150);
}

TEST(FasterSetup, HasNoErrorToTellOfMotionsThatLoadsDoNotMake) {
  const auto struck = faster_way_of(board(2, "corotational") + "initial: {velocity_field: [0, 0, x]}\n");
  ASSERT_TRUE(struck);
  EXPECT_TRUE(std::isinf(*struck->error));
  EXPECT_FALSE(struck->pays());
}

TEST(FasterSetup, PaysWhereItSavesMuchAndCostsLittle) {
  const FasterSetup way{.changes = {}, .method = {}, .now = 30, .then = 9, .error = 0.019};
  EXPECT_TRUE(way.pays());
  FasterSetup slow = way, wrong = way;
  slow.then = 11;
  wrong.error = 0.021;
  EXPECT_FALSE(slow.pays());
  EXPECT_FALSE(wrong.pays());
}

}  // namespace
}  // namespace orthodyn::modes_by_auto_test
