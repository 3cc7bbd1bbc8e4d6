// `kinematics: auto` against runs with linear and with corotational kinematics.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "lib/simulation/error_estimate/error_norms.h"
#include "lib/simulation/error_estimate/recorders.h"
#include "lib/simulation/run/run.h"
#include "lib/simulation/run/setup.h"
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
  for (const double force : {1.0, 100.0, 3e3}) all.push_back({fmt::format("across_{}_N", force), kBar + across(force)});
  for (const double force : {3e3, 3e5})  // held at both ends: its midline is stretched
    all.push_back({fmt::format("between_{}_N", force), fmt::format("{}clamps: [{{surface: x0}}, {{surface: x1}}]\n"
                                                                   "gravity: [0, 0, {}]\ntime: {{end: 0.02}}\n",
                                                                   kBar, -force / 10)});
  for (const double force : {1e4, 3e6})
    all.push_back({fmt::format("along_{}_N", force),
                   fmt::format("{}clamps: [{{surface: x0}}]\nloads: [{{surface: x1, force: [{}, 0, 0]}}]\n"
                               "time: {{end: 0.01}}\n",
                               kBar, force)});
  for (const double spin : {1e-3, 5.0})
    all.push_back({fmt::format("free_{}", spin),
                   fmt::format("{}initial: {{spin: [0, 0, {}]}}\ntime: {{end: 0.1}}\n", kBar, spin)});
  all.push_back({"shaken", std::string(kBar) + "clamps: [{surface: x0}]\nloads: [{surface: x1, force: [0, 0, -20], "
                                               "factor: {type: sine, frequency: 20 Hz}}]\ntime: {end: 0.3}\n"});
  return all;
}

Setup set_up(const Motion& motion, const std::string& kinematics) {
  return orthodyn::set_up(Config::from_text(
      motion.scene + fmt::format("integrator: {{type: arkode_dirk, rtol: 1e-5}}\nelasticity: {{kinematics: {}{}}}\n",
                                 kinematics, kinematics == "auto" ? fmt::format(", linear_error: {}", kAllowed) : "")));
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
INSTANTIATE_TEST_SUITE_P(Scenes, Choice, testing::ValuesIn(motions()), [](const auto& motion) {
  std::string name = motion.param.name;
  std::replace_if(
      name.begin(), name.end(), [](char c) { return !std::isalnum(static_cast<unsigned char>(c)); }, '_');
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
    EXPECT_NE(keeps_linear, chosen.linearity->exceeds_allowed());
    estimate = chosen.linearity->error();
  }
  if (error > kAllowed) {
    EXPECT_FALSE(keeps_linear) << error;
  }
  if (error < kAllowed / 5) {
    EXPECT_TRUE(keeps_linear) << error << " estimated " << estimate;
  }
  if (keeps_linear) {
    EXPECT_GE(estimate, 0.5 * error);
  }
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

// A load that grows slowly to its peak near the end: linear kinematics are valid at first only.
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

// A driven beam whose motion grows after the first end time: a continued run must monitor the error as well, in either
// form.
TEST_F(Kinematics, AreWatchedWhereARunGoesOn) {
  write("scene.yaml",
        std::string(kBar) +
            "clamps: [{surface: x0}]\nloads: [{surface: x1, force: [0, 0, -10], factor: {type: expression, formula: "
            "\"t < 0.02 ? 50*t : 1 + 1e4*(t - 0.02)\", kinks: [0.02]}}]\ntime: {end: 0.02}\ncheckpoint: {}\n"
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

// A restart keeps the largest error and the start of the phase.
TEST_F(Kinematics, AreRememberedOverARestart) {
  write("scene.yaml", kBar + across(100) +
                          "checkpoint: {}\nintegrator: {type: cvode_bdf}\n"
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
  write("scene.yaml", kBar + across(3e3) +
                          "checkpoint: {}\nintegrator: {type: cvode_bdf}\n"
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

// A nonlinear model: the tangent is evaluated at each check.
TEST_F(Kinematics, AreWatchedBesideLoadsThatFollow) {
  for (const auto& [pressure, word] : {std::pair{1.0, "linear: off by"}, {1e4, "corotational: linear kinematics"}}) {
    write("scene.yaml",
          fmt::format("{}clamps: [{{surface: x0}}]\nterms: [{{type: pressure, surface: z1, pressure: {}}}]\n"
                      "time: {{end: 0.05}}\nintegrator: {{type: cvode_bdf}}\nelasticity: {{kinematics: auto}}\n",
                      kBar, pressure));
    const auto result = orthodyn("run scene.yaml --force --out out");
    ASSERT_EQ(result.exit_code, 0) << result.output;
    EXPECT_NE(result.output.find(word), std::string::npos) << result.output;
    EXPECT_NE(read_text(folder_ / "out/scene.yaml").find("follows: true"), std::string::npos);
  }
}

// A stiff foot that hardly moves carries an arm with large motion.
const char* const kFootAndArm = R"(
mesh: {type: box, size: [0.8, 0.1, 0.05], cells: [8, 1, 1], parts: {arm: {min: [0.3, -1, -1], max: [1, 1, 1]}}}
materials:
  stiff: {type: isotropic, density: 2000, young: 2e10, nu: 0.3}
  soft: {type: isotropic, density: 1000, young: 5e7, nu: 0.3}
regions: {body: {material: stiff}, arm: {material: soft}}
clamps: [{surface: x0}]
damping: {stiffness: 1e-3}
output: {probes: {tip: {at: [0.8, 0.05, 0.025]}, foot: {at: [0.3, 0.05, 0.025]}}}
)";

using Rows = std::vector<std::vector<double>>;

// Error of the first probe's displacement.
Vec3 probe(const std::vector<double>& row) { return {row[1], row[2], row[3]}; }

double largest_of(const Rows& rows) {
  double largest = 0;
  for (const auto& row : rows) largest = std::max(largest, probe(row).norm());
  return largest;
}

double difference(const Rows& a, const Rows& b) {
  EXPECT_EQ(a.size(), b.size());
  double largest = 0;
  for (std::size_t i = 0; i < std::min(a.size(), b.size()); ++i)
    largest = std::max(largest, (probe(a[i]) - probe(b[i])).norm());
  return largest / largest_of(b);
}

TEST_F(Kinematics, AreChosenRegionByRegion) {
  write("scene.yaml", std::string(kFootAndArm) +
                          "gravity: [0, 0, -9.81]\ntime: {end: 0.5}\nintegrator: {type: arkode_dirk, rtol: 1e-6}\n"
                          "elasticity: {kinematics: auto, linear_error: 1e-3}\n");
  const auto mixed = orthodyn("run scene.yaml --out mixed");
  ASSERT_EQ(mixed.exit_code, 0) << mixed.output;
  EXPECT_NE(mixed.output.find("linear in body: off by about"), std::string::npos) << mixed.output;
  EXPECT_NE(mixed.output.find("; corotational in arm: linear kinematics would be"), std::string::npos) << mixed.output;
  EXPECT_NE(mixed.output.find("elasticity      small strain; corotational, exact gradient"), std::string::npos)
      << mixed.output;
  ASSERT_EQ(orthodyn("run scene.yaml --out exact --set elasticity.kinematics=corotational elasticity.linear_error=null")
                .exit_code,
            0);
  ASSERT_EQ(
      orthodyn("run scene.yaml --out linear --set elasticity.kinematics=linear elasticity.linear_error=null").exit_code,
      0);
  const auto exact = read_rows(folder_ / "exact/probes.csv"), near = read_rows(folder_ / "mixed/probes.csv");
  const auto far = read_rows(folder_ / "linear/probes.csv");
  EXPECT_LT(difference(near, exact), 1e-3);
  EXPECT_GT(difference(near, exact), 0);
  EXPECT_GT(difference(far, exact), 1e-2);
  // The resolved scene repeats the run.
  ASSERT_EQ(orthodyn("run mixed/scene.yaml --out again").exit_code, 0);
  EXPECT_EQ(read_text(folder_ / "mixed/probes.csv"), read_text(folder_ / "again/probes.csv"));
}

// Without the phase, independent of the order of the keys.
TEST_F(Kinematics, OfAStaticAnalysisAreChosenRegionByRegion) {
  const std::string scene = std::string(kFootAndArm) +
                            "gravity: [0, 0, -98.1]\nanalysis: static\n"
                            "elasticity: {kinematics: auto, linear_error: 1e-3}\n";
  const std::string before = "{body: {material: stiff}, arm: {material: soft}}";
  const std::string after = "{arm: {material: soft}, body: {material: stiff}}";
  const auto at = scene.find(before);
  ASSERT_NE(at, std::string::npos);
  for (const std::string& regions : {before, after}) {
    std::string text = scene;
    write("scene.yaml", text.replace(at, before.size(), regions));
    const auto result = orthodyn("run scene.yaml --force --out out");
    ASSERT_EQ(result.exit_code, 0) << result.output;
    EXPECT_NE(result.output.find("linear in body: off by about"), std::string::npos) << result.output;
    EXPECT_NE(result.output.find("; corotational in arm: "), std::string::npos) << result.output;
  }
}

TEST_F(Kinematics, OfRegionsWithADotInTheirNameAreKeptWhereARunGoesOn) {
  std::string text = std::string(kFootAndArm) +
                     "gravity: [0, 0, -9.81]\ntime: {end: 0.1}\ncheckpoint: {}\n"
                     "integrator: {type: cvode_bdf}\n"
                     "elasticity: {kinematics: auto, linear_error: 1e-3}\n";
  for (auto at = text.find("arm: {"); at != std::string::npos; at = text.find("arm: {", at + 8))
    text.replace(at, 4, "arm.1:");
  write("scene.yaml", text);
  const auto first = orthodyn("run scene.yaml --out out --set time.end=0.05");
  ASSERT_EQ(first.exit_code, 0) << first.output;
  EXPECT_NE(first.output.find("; corotational in arm.1: "), std::string::npos) << first.output;
  const auto later = orthodyn("run scene.yaml --out out --resume");
  EXPECT_EQ(later.exit_code, 0) << later.output;
}

// The amplitude of the arm is not known in advance.
TEST_F(Kinematics, OutgrownInOneRegionStayLinearInTheOther) {
  write("scene.yaml", std::string(kFootAndArm) +
                          "initial: {velocity: [0, 0, 2]}\ntime: {end: 0.1}\nintegrator: {type: cvode_bdf}\n"
                          "checkpoint: {}\nelasticity: {kinematics: auto, linear_error: 0.02}\n");
  const auto again = orthodyn("run scene.yaml --out out --set time.end=0.05");
  ASSERT_EQ(again.exit_code, 0) << again.output;
  EXPECT_NE(again.output.find("starts again with corotational kinematics"), std::string::npos) << again.output;
  EXPECT_NE(again.output.find("linear in body: off by about"), std::string::npos) << again.output;
  EXPECT_NE(again.output.find("; corotational in arm: linear kinematics are off by"), std::string::npos)
      << again.output;
  const auto later = orthodyn("run scene.yaml --out out --resume");
  ASSERT_EQ(later.exit_code, 0) << later.output;
  EXPECT_EQ(later.output.find("starts again"), std::string::npos) << later.output;
  EXPECT_NE(later.output.find("linear in body: off by about"), std::string::npos) << later.output;
}

TEST_F(Kinematics, OfARegionOverrideThoseOfAll) {
  const std::string scene = std::string(kFootAndArm) +
                            "gravity: [0, 0, -9.81]\ntime: {end: 0.01}\n"
                            "integrator: {type: cvode_bdf}\n";
  write("scene.yaml", scene);
  const auto by_hand = orthodyn("run scene.yaml --out a --set regions.body.kinematics=linear");
  ASSERT_EQ(by_hand.exit_code, 0) << by_hand.output;
  EXPECT_NE(by_hand.output.find("kinematics      linear in body: off by about"), std::string::npos) << by_hand.output;
  const auto open = orthodyn("run scene.yaml --out b --set regions.body.kinematics=auto");
  ASSERT_EQ(open.exit_code, 0) << open.output;
  EXPECT_NE(open.output.find("linear in body: off by about"), std::string::npos) << open.output;
  const auto meaningless = orthodyn("check scene.yaml --set elasticity.linear_error=0.1");
  EXPECT_NE(meaningless.output.find("linear_error: has no effect without kinematics: auto"), std::string::npos)
      << meaningless.output;
  const auto warped = orthodyn("check scene.yaml --set regions.body.kinematics=auto elasticity.corotation=warped");
  EXPECT_NE(warped.output.find("regions.body: kinematics: auto supports the exact force"), std::string::npos)
      << warped.output;
}

// Kinematics set by the user are kept. The summary states their error, and a warning says if others are needed.
TEST_F(Kinematics, ThatAreLinearByHandTellHowFarOffTheyAre) {
  write("scene.yaml",
        kBar + across(100) +
            "integrator: {type: cvode_bdf, rtol: 1e-5}\noutput: {probes: {tip: {at: [1, 0.05, 0.05]}}}\n");
  ASSERT_EQ(orthodyn("run scene.yaml --out exact").exit_code, 0);
  const auto linear = orthodyn("run scene.yaml --out linear --set elasticity.kinematics=linear");
  ASSERT_EQ(linear.exit_code, 0) << linear.output;
  EXPECT_EQ(linear.output.find("elasticity.kinematics: auto"), std::string::npos) << linear.output;
  const double told = std::stod(linear.output.substr(linear.output.find("linear: off by about ") + 21));
  const auto exact = read_rows(folder_ / "exact/probes.csv"), rows = read_rows(folder_ / "linear/probes.csv");
  const double error = difference(rows, exact);
  EXPECT_GT(told, 0.5 * error);
  EXPECT_LT(told, 5 * error);
  for (const char* analysis : {"dynamic", "static"}) {
    write("far.yaml", kBar + across(3e4) + "elasticity: {kinematics: linear}\nanalysis: " + analysis + "\n");
    const auto far = orthodyn(std::string("run far.yaml --force --out far") +
                              (analysis == std::string("dynamic") ? " --set integrator.type=cvode_bdf" : ""));
    ASSERT_EQ(far.exit_code, 0) << far.output;
    EXPECT_NE(far.output.find("elasticity.kinematics: auto"), std::string::npos) << far.output;
  }
}

// The linear response of a slender body stretches it. The exact force then differs much from the linear one, although
// the error of the motion is small.
TEST_F(Kinematics, ThatAreLinearInAStripAreOffByTheShareThatTheyAre) {
  write("strip.yaml", R"(analysis: static
mesh: {type: box, size: [0.4, 0.04, 0.012], cells: [8, 2, 1]}
materials: {s: {type: preset, name: sitka_spruce}}
clamps: [{surface: x0}]
loads: [{surface: x1, force: [0, 0, -5]}]
output: {probes: {tip: {at: [0.4, 0.02, 0.006]}}}
)");
  ASSERT_EQ(orthodyn("run strip.yaml --out exact").exit_code, 0);
  const auto linear = orthodyn("run strip.yaml --out linear --set elasticity.kinematics=linear");
  ASSERT_EQ(linear.exit_code, 0) << linear.output;
  const auto exact = read_rows(folder_ / "exact/probes.csv"), rows = read_rows(folder_ / "linear/probes.csv");
  const auto there = probe(exact.back()), here = probe(rows.back());
  const double error = (there - here).norm() / there.norm();
  const auto at = linear.output.find("off by about ");
  ASSERT_NE(at, std::string::npos) << linear.output;
  const double told = std::stod(linear.output.substr(at + 13));
  EXPECT_GT(told, 0.3 * error);
  EXPECT_LT(told, 3 * error);
}

}  // namespace
}  // namespace orthodyn::kinematics_test
