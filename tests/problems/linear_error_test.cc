// The estimated error of linear kinematics, against a run with the exact force.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "lib/simulation/error_estimate/error_norms.h"
#include "lib/simulation/error_estimate/recorders.h"
#include "lib/simulation/run/kinematics.h"
#include "lib/simulation/run/run.h"
#include "lib/simulation/run/setup.h"
#include "tests/simulation/result_reader.h"
#include "tests/simulation/run_program.h"

namespace orthodyn::linear_error_test {
namespace {

struct Case {
  std::string name, scene;
};

// A spruce board supported along two lines of its lower face, struck in the middle.
std::string tapped_board(double force) {
  return fmt::format(R"(
mesh: {{type: box, size: [0.4, 0.06, 0.004], cells: [12, 2, 1], elements: tetrahedra}}
materials: {{s: {{type: preset, name: sitka_spruce}}}}
damping: {{mass: 4, stiffness: 1e-6}}
clamps:
  - {{box: {{min: [0.066, 0, 0], max: [0.067, 0.06, 0]}}, components: [z]}}
  - {{box: {{min: [0.333, 0, 0], max: [0.334, 0.06, 0]}}, components: [z]}}
  - {{nearest: [0.0667, 0, 0], components: [x, y]}}
  - {{nearest: [0.3333, 0, 0], components: [y]}}
terms:
  - {{type: point_load, nearest: [0.2, 0.03, 0.004], force: [0, 0, -{}],
      factor: {{type: expression, formula: "t < 2e-3 ? sin(pi*t/2e-3) : 0", kinks: [2 ms], peak: 1}}}}
time: {{end: 0.25}}
)",
                     force);
}

std::string beam(const std::string& loads, const std::string& rest) {
  return "mesh: {type: box, size: [1, 0.1, 0.1], cells: [8, 1, 1]}\n"
         "materials: {m: {type: isotropic, density: 1000, young: 1e9, nu: 0.3}}\n"
         "clamps: [{surface: x0}]\n" +
         loads + "\n" + rest + "\n";
}

const char* const kFactor = ", factor: {type: sine, frequency: 20 Hz}";

std::string across(double force, const char* factor = "") {
  return fmt::format("loads: [{{surface: x1, force: [0, 0, {}]{}}}]", -force, factor);
}

std::vector<Case> cases() {
  std::vector<Case> all;
  const auto add = [&](const std::string& name, std::string scene) { all.push_back({name, std::move(scene)}); };
  for (const double force : {2.0, 20.0}) add(fmt::format("board_{:.0f}_N", force), tapped_board(force));
  for (const double force : {10.0, 200.0})
    add(fmt::format("step_{:.0f}_N", force), beam(across(force), "time: {end: 0.25}"));
  add("damped_step", beam(across(100), "damping: {mass: 20}\ntime: {end: 0.3}"));
  add("struck", beam("initial: {velocity: [0, 0, 1]}", "time: {end: 0.25}"));
  add("shaken", beam(across(20, kFactor), "time: {end: 0.25}"));
  add("shaken_damped", beam(across(20, kFactor), "damping: {mass: 20}\ntime: {end: 0.3}"));
  // No wave front travels through the bar: the phases of very many modes cannot be tracked.
  add("along", beam("loads: [{surface: x1, force: [1e6, 0, 0], factor: {type: expression, formula: \"t < 5e-3 ? "
                    "sin(pi*t/1e-2)^2 : 1\", kinks: [5 ms]}}]",
                    "time: {end: 0.03}"));
  add("plate", R"(
mesh: {type: box, size: [0.4, 0.3, 0.01], cells: [4, 3, 1]}
materials: {s: {type: preset, name: sitka_spruce}}
clamps: [{surface: x0}, {surface: x1}, {surface: y0}, {surface: y1}]
gravity: [0, 0, -1000]
time: {end: 0.02}
)");
  return all;
}

orthodyn::Setup set_up(const Case& motion, const char* kinematics) {
  return orthodyn::set_up(Config::from_text(
      motion.scene +
      fmt::format("integrator: {{type: arkode_dirk, rtol: 1e-5}}\nelasticity: {{kinematics: {}}}\n", kinematics)));
}

Trajectory trajectory(const orthodyn::Setup& setup) {
  constexpr int kOutputs = 400;
  const std::atomic<bool> never{false};
  const auto& time = setup.scene.time;
  TrajectoryRecorder recorder(kOutputs);
  std::vector<Observer*> observers{&recorder};
  if (setup.linearity) observers.push_back(setup.linearity.get());
  const Outcome outcome =
      orthodyn::run(*setup.built.model, *setup.integrator, setup.built.initial,
                    {.end = time.end, .output_times = evenly_spaced(time.start, time.end, kOutputs)}, observers, never);
  EXPECT_EQ(outcome.status, Outcome::Status::completed);
  if (setup.linearity) setup.linearity->finish();
  return recorder.trajectory();
}

class LinearErrors : public InFolder {};

TEST_F(LinearErrors, AreToldOfAStaticDeflection) {
  for (const double force : {100.0, 1000.0}) {
    write("static.yaml", beam(across(force), "analysis: static\noutput: {probes: {tip: {at: [1, 0.05, 0.05]}}}"));
    ASSERT_EQ(orthodyn("run static.yaml --force --out exact").exit_code, 0);
    const auto linear = orthodyn("run static.yaml --force --out linear --set elasticity.kinematics=linear");
    ASSERT_EQ(linear.exit_code, 0) << linear.output;
    const auto there = read_rows(folder_ / "exact/probes.csv").back();
    const auto here = read_rows(folder_ / "linear/probes.csv").back();
    const Vec3 exact(there[1], there[2], there[3]), found(here[1], here[2], here[3]);
    const auto at = linear.output.find("off by about ");
    ASSERT_NE(at, std::string::npos) << linear.output;
    const double told = std::stod(linear.output.substr(at + 13)), error = (found - exact).norm() / exact.norm();
    EXPECT_GT(told, 0.5 * error);
    EXPECT_LT(told, 2 * error);
  }
}

// The summary and the warning use the same word.
TEST_F(LinearErrors, OfLargeRotationsAreWarnedOf) {
  write("far.yaml", beam(across(3000),
                         "time: {end: 0.1}\nintegrator: {type: cvode_bdf}\n"
                         "elasticity: {kinematics: linear}"));
  const auto far = orthodyn("run far.yaml --force --out far");
  ASSERT_EQ(far.exit_code, 0) << far.output;
  EXPECT_NE(far.output.find("warning: linear kinematics are off by about "), std::string::npos) << far.output;
  EXPECT_NE(far.output.find("kinematics      linear: off by about "), std::string::npos) << far.output;
  EXPECT_EQ(far.output.find("at most"), std::string::npos) << far.output;
}

class LinearError : public testing::TestWithParam<Case> {};
INSTANTIATE_TEST_SUITE_P(Scenes, LinearError, testing::ValuesIn(cases()),
                         [](const auto& one) { return one.param.name; });

TEST_P(LinearError, IsToldWithinAFewTimes) {
  const orthodyn::Setup exact = set_up(GetParam(), "corotational"), linear = set_up(GetParam(), "linear");
  const double error =
      ReferenceNorms(*exact.built.model, trajectory(exact), {}).errors(trajectory(linear)).displacement.max;
  const double told = linear.linearity->error();
  EXPECT_GT(told, 0.5 * error);
  EXPECT_LT(told, 4 * error);
}

}  // namespace
}  // namespace orthodyn::linear_error_test
