// `kinematics: auto` against what runs with either kinematics say.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "lib/simulation/errors/error_norms.h"
#include "lib/simulation/run.h"
#include "lib/simulation/setup.h"
#include "tests/simulation/result_reader.h"
#include "tests/simulation/run_program.h"

namespace orthodyn::kinematics_test {
namespace {

constexpr double kAllowed = 0.01;

const char* const kBar = R"(
mesh: {type: box, size: [1, 0.1, 0.1], cells: [8, 1, 1]}
materials: {m: {type: isotropic, density: 1000, young: 1e9, nu: 0.3}}
)";
const char* const kAcross = "clamps: [{surface: x0}]\nloads: [{surface: x1, force: [0, 0, -1]}]\ntime: {end: 0.1}\n";

struct Motion {
  std::string name, scene;
};

std::string across(double force) {
  std::string text = kAcross;
  return text.replace(text.find("-1]"), 3, fmt::format("{}]", -force));
}

// Rotations, stretched midlines, strains, loads in time, initial velocities; small and large of each.
std::vector<Motion> motions() {
  std::vector<Motion> all;
  for (const double force : {1.0, 100.0, 3e3})
    all.push_back({fmt::format("across_{}_N", force), kBar + across(force)});
  for (const double force : {3e3, 3e5})  // held at both ends: its midline is stretched
    all.push_back({fmt::format("between_{}_N", force),
                   fmt::format("{}clamps: [{{surface: x0}}, {{surface: x1}}]\n"
                               "gravity: [0, 0, {}]\ntime: {{end: 0.02}}\n",
                               kBar, -force / 10)});
  for (const double force : {1e4, 3e6})
    all.push_back({fmt::format("along_{}_N", force),
                   fmt::format("{}clamps: [{{surface: x0}}]\nloads: [{{surface: x1, force: [{}, 0, 0]}}]\n"
                               "time: {{end: 0.01}}\n", kBar, force)});
  for (const double spin : {1e-3, 5.0})
    all.push_back({fmt::format("free_{}", spin),
                   fmt::format("{}initial: {{spin: [0, 0, {}]}}\ntime: {{end: 0.1}}\n", kBar, spin)});
  all.push_back({"shaken", std::string(kBar) +
                               "clamps: [{surface: x0}]\nloads: [{surface: x1, force: [0, 0, -20], factor: {type: "
                               "sine, frequency: 20 Hz}}]\ntime: {end: 0.3}\n"});
  return all;
}

Setup set_up(const Motion& motion, const std::string& kinematics) {
  return orthodyn::set_up(Config::from_text(motion.scene + fmt::format(
      "integrator: {{type: arkode_dirk, rtol: 1e-6}}\nelasticity: {{kinematics: {}{}}}\n", kinematics,
      kinematics == "auto" ? fmt::format(", linear_error: {}", kAllowed) : "")));
}

Outcome run(const Setup& setup, std::vector<Observer*> observers) {
  const std::atomic<bool> never{false};
  const auto& time = setup.scene.time;
  return orthodyn::run(*setup.built.model, *setup.integrator, setup.built.initial,
                       {.end = time.end, .output_times = evenly_spaced(time.start, time.end, 40)}, observers, never);
}

Trajectory trajectory(const Setup& setup) {
  TrajectoryRecorder recorder(40);
  EXPECT_EQ(run(setup, {&recorder}).status, Outcome::Status::completed);
  return recorder.trajectory();
}

class Choice : public testing::TestWithParam<Motion> {};
INSTANTIATE_TEST_SUITE_P(Scenes, Choice, testing::ValuesIn(motions()), [](const auto& info) {
  std::string name = info.param.name;
  std::replace_if(name.begin(), name.end(), [](char c) { return !std::isalnum(static_cast<unsigned char>(c)); }, '_');
  return name;
});

TEST_P(Choice, IsWhatRunsWithEitherKinematicsSay) {
  const orthodyn::Setup exact = set_up(GetParam(), "corotational"), linear = set_up(GetParam(), "linear");
  const double error =
      ReferenceNorms(*exact.built.model, trajectory(exact), {}).errors(trajectory(linear)).displacement.max;

  const orthodyn::Setup chosen = set_up(GetParam(), "auto");
  ASSERT_TRUE(chosen.kinematics);
  bool keeps_linear = chosen.kinematics->linear;
  double estimate = -1;
  if (keeps_linear) {
    ASSERT_TRUE(chosen.linearity);
    keeps_linear = run(chosen, {chosen.linearity.get()}).status == Outcome::Status::completed;
    EXPECT_NE(keeps_linear, chosen.linearity->outgrown());
    estimate = chosen.linearity->error();
  }
  if (error > kAllowed) EXPECT_FALSE(keeps_linear) << error;
  if (error < kAllowed / 5) EXPECT_TRUE(keeps_linear) << error << " estimated " << estimate;
  if (keeps_linear) EXPECT_GE(estimate, 0.5 * error);
}

class Kinematics : public InFolder {};

TEST_F(Kinematics, AreTold) {
  write("scene.yaml", kBar + across(1) + "integrator: {type: cvode_bdf}\nelasticity: {kinematics: auto}\n");
  const auto small = orthodyn("run scene.yaml --out small");
  ASSERT_EQ(small.exit_code, 0) << small.output;
  EXPECT_NE(small.output.find("kinematics      linear: off by about"), std::string::npos) << small.output;
  EXPECT_NE(read_text(folder_ / "small/run.json").find("\"kinematics\": \"linear: off by"), std::string::npos);
  const auto large = orthodyn("run scene.yaml --out large --set 'loads.0.force=[0, 0, -3000]'");
  ASSERT_EQ(large.exit_code, 0) << large.output;
  EXPECT_NE(large.output.find("kinematics      corotational: linear kinematics would be off by"), std::string::npos)
      << large.output;
}

// A load that grows slowly to its peak near the end: linear at first, then outgrown.
TEST_F(Kinematics, OutgrownMeansARunFromTheStartThatLosesNothing) {
  const std::string bar = std::string(kBar) +
                          "clamps: [{surface: x0}]\ninitial: {velocity: [0, 0, 2]}\ntime: {end: 0.05}\n"
                          "integrator: {type: cvode_bdf}\noutput: {probes: {tip: {at: [1, 0.05, 0.05]}}}\n";
  write("auto.yaml", bar + "elasticity: {kinematics: auto, linear_error: 0.01}\n");
  write("exact.yaml", bar + "elasticity: {kinematics: corotational}\n");
  const auto again = orthodyn("run auto.yaml --out again");
  ASSERT_EQ(again.exit_code, 0) << again.output;
  EXPECT_NE(again.output.find("starts again with corotational kinematics"), std::string::npos) << again.output;
  EXPECT_NE(again.output.find("kinematics      corotational: linear kinematics are off by"), std::string::npos);
  ASSERT_EQ(orthodyn("run exact.yaml --out exact").exit_code, 0);
  EXPECT_EQ(read_text(folder_ / "again/probes.csv"), read_text(folder_ / "exact/probes.csv"));
  EXPECT_EQ(read_text(folder_ / "again/energy.csv"), read_text(folder_ / "exact/energy.csv"));
}

// A driven beam whose motion grows after the first end: whoever goes on from it is to watch, too, by either form.
TEST_F(Kinematics, AreWatchedWhereARunGoesOn) {
  write("scene.yaml",
        std::string(kBar) +
            "clamps: [{surface: x0}]\nloads: [{surface: x1, force: [0, 0, -10], factor: {type: expression, "
            "formula: \"t < 0.02 ? 50*t : 1 + 1e4*(t - 0.02)\", kinks: [0.02]}}]\ntime: {end: 0.02}\ncheckpoint: {}\n"
            "integrator: {type: cvode_bdf}\nelasticity: {kinematics: auto, linear_error: 0.01}\n");
  const auto first = orthodyn("run scene.yaml --out a");
  ASSERT_EQ(first.exit_code, 0) << first.output;
  ASSERT_NE(first.output.find("kinematics      linear: off by"), std::string::npos) << first.output;
  fs::copy(folder_ / "a", folder_ / "b", fs::copy_options::recursive);
  for (const char* form : {"run scene.yaml --out a", "run b"}) {
    const auto again = orthodyn(std::string(form) + " --resume --set time.end=0.022");
    ASSERT_EQ(again.exit_code, 0) << again.output;
    EXPECT_NE(again.output.find("kinematics      linear: off by"), std::string::npos) << again.output;
  }
  const auto grown = orthodyn("run b --resume --set time.end=0.05");
  EXPECT_NE(grown.output.find("kinematics      corotational"), std::string::npos) << grown.output;
}

// What it knew before a restart counts: the largest error is kept, and so is the start of the phase.
TEST_F(Kinematics, AreRememberedOverARestart) {
  write("scene.yaml", kBar + across(100) + "checkpoint: {}\nintegrator: {type: cvode_bdf}\n"
                                           "elasticity: {kinematics: auto, linear_error: 0.05}\n");
  const auto error = [&](const std::string& folder) {
    const std::string record = read_text(folder_ / folder / "run.json");
    const auto at = record.find("off by about ");
    return at == std::string::npos ? -1.0 : std::stod(record.substr(at + 13));
  };
  ASSERT_EQ(orthodyn("run scene.yaml --out whole").exit_code, 0);
  ASSERT_EQ(orthodyn("run scene.yaml --out parts --set time.end=0.07").exit_code, 0);
  ASSERT_EQ(orthodyn("run scene.yaml --out parts --resume").exit_code, 0);
  EXPECT_GT(error("whole"), 0);
  EXPECT_NEAR(error("parts"), error("whole"), 0.1 * error("whole"));
}

TEST_F(Kinematics, ThatWereChosenCorotationalStaySoWhereARunGoesOn) {
  write("scene.yaml", kBar + across(3e3) + "checkpoint: {}\nintegrator: {type: cvode_bdf}\n"
                                           "elasticity: {kinematics: auto, linear_error: 0.01}\n");
  ASSERT_EQ(orthodyn("run scene.yaml --out a --set time.end=0.05").exit_code, 0);
  const auto again = orthodyn("run scene.yaml --out a --resume");
  EXPECT_EQ(again.exit_code, 0) << again.output;
}

TEST_F(Kinematics, OfAStaticAnalysisAreCheckedAtItsEnd) {
  for (const auto& [force, word] : {std::pair{1.0, "linear: off by"}, {1e4, "corotational: linear"}}) {
    write("static.yaml", kBar + across(force) + "analysis: static\nelasticity: {kinematics: auto}\n");
    const auto result = orthodyn("run static.yaml --force --out out");
    ASSERT_EQ(result.exit_code, 0) << result.output;
    EXPECT_NE(result.output.find(word), std::string::npos) << result.output;
  }
}

TEST_F(Kinematics, ThatAreLeftOpenAreCorotationalWhereLoadsFollow) {
  write("scene.yaml",
        std::string(kBar) +
            "clamps: [{surface: x0}]\nterms: [{type: pressure, surface: x1, pressure: 1}]\ntime: {end: 0.01}\n"
            "elasticity: {kinematics: auto}\n");
  const auto result = orthodyn("run scene.yaml --out out");
  ASSERT_EQ(result.exit_code, 0) << result.output;
  EXPECT_NE(result.output.find("corotational: loads, contact or supports are not linear anyway"), std::string::npos)
      << result.output;
}

}  // namespace
}  // namespace orthodyn::kinematics_test
