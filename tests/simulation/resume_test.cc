// Completed runs that are extended, and locking of the result folder.
#include "lib/simulation/output/json.h"
#include "tests/simulation/resume_fixture.h"

namespace orthodyn::resume_test {
namespace {

TEST_F(Resume, ACompletedRunIsLeftAloneAndCanBeExtended) {
  write("beam.yaml", kBeam + std::string(kFixedStep));
  ASSERT_EQ(orthodyn("run beam.yaml --quiet --set time.end=0.6 --set output.frames=8 --resume").exit_code, 0);
  const auto frames = read_text(folder_ / "out/beam/frames.pvd");
  const auto again = orthodyn("run out/beam --resume");
  EXPECT_EQ(again.exit_code, 0);
  EXPECT_NE(again.output.find("is complete"), std::string::npos) << again.output;
  EXPECT_EQ(read_text(folder_ / "out/beam/frames.pvd"), frames);

  const auto longer = orthodyn("run out/beam --resume --set time.end=1.2");
  ASSERT_EQ(longer.exit_code, 0) << longer.output;
  ASSERT_EQ(orthodyn("run beam.yaml --quiet --set time.end=1.2 --set output.frames=16 --out whole").exit_code, 0);
  const auto times = read_times(folder_ / "out/beam/frames.pvd"), expected = read_times(folder_ / "whole/frames.pvd");
  ASSERT_EQ(times.size(), expected.size());
  for (std::size_t k = 0; k < times.size(); ++k) EXPECT_NEAR(times[k], expected[k], 1e-12);
  EXPECT_EQ(record("out/beam")["restarts"][0]["changed"], Json::array({"time.end"}));
}

TEST_F(Resume, OneRunAtATimeWorksInAFolder) {
  write("swing.yaml", kSwing + std::string("checkpoint: {every: 0.01}\n"));
  const std::string run = program() + " run swing.yaml --quiet --set time.end=1e3 --set integrator.h_max=1e-5 ";
  const auto tried = shell("cd " + folder_.string() + " && { " + run +
                           "& pid=$!; for i in $(seq 200); do [ -s out/swing/steps.csv ] && break; sleep 0.05; done; "
                           "for how in --resume --force ''; do timeout 5 " +
                           run + "$how; echo \"code $?\"; done; kill -TERM $pid; wait $pid; }");
  EXPECT_EQ(tried.exit_code, 130);
  std::size_t refused = 0;
  for (std::size_t at = 0; (at = tried.output.find("another run is at work there", at)) != std::string::npos; ++at)
    ++refused;
  EXPECT_EQ(refused, 3u) << tried.output;
  EXPECT_EQ(tried.output.find("code 0"), std::string::npos) << tried.output;
}

TEST_F(Resume, AFolderWithNothingButALockIsEmpty) {
  write("swing.yaml", kSwing);
  fs::create_directories(folder_ / "out/swing");
  write("out/swing/.orthodyn-run", "");
  const auto result = orthodyn("run swing.yaml --quiet");
  EXPECT_EQ(result.exit_code, 0) << result.output;
}

TEST_F(Resume, TimesWithAUnitAreUnderstoodWhereARunIsComplete) {
  write("swing.yaml", kSwing);
  ASSERT_EQ(orthodyn("run swing.yaml --quiet --set 'time.end=500 ms'").exit_code, 0);
  const auto result = orthodyn("run swing.yaml --resume --set 'time.end=500 ms'");
  EXPECT_EQ(result.exit_code, 0) << result.output;
  EXPECT_NE(result.output.find("complete at t = 0.5 s"), std::string::npos) << result.output;
}

TEST_F(Resume, TheSameValueInAnotherUnitIsNoChange) {
  write("swing.yaml", kSwing + std::string("checkpoint: {every: 60}\n"));
  ASSERT_EQ(orthodyn("run swing.yaml --quiet --set 'materials.soft.young=0.1 MPa'").exit_code, 0);
  const auto result = orthodyn("run swing.yaml --quiet --resume --set time.end=0.6");
  EXPECT_EQ(result.exit_code, 0) << result.output;
  const auto other =
      orthodyn("run swing.yaml --quiet --resume --set time.end=0.7 --set 'materials.soft.young=0.2 MPa'");
  EXPECT_EQ(other.exit_code, 2);
  EXPECT_NE(other.output.find("materials.soft.young differs"), std::string::npos) << other.output;
}

TEST_F(Resume, ARunWithoutAnIntegratorKeepsTheOneThatWasChosen) {
  write("beam.yaml", kBeam + std::string("time: {end: 0.5}\n"));
  ASSERT_EQ(orthodyn("run beam.yaml --quiet --out out").exit_code, 0);
  const auto result = orthodyn("run beam.yaml --quiet --out out --resume --set time.end=1");
  EXPECT_EQ(result.exit_code, 0) << result.output;
  EXPECT_EQ(record("out").at("time_reached"), 1.0);
  EXPECT_EQ(record("out").at("status"), "completed");
}

// Modes chosen by `auto` are kept, like every automatic choice.
TEST_F(Resume, ARunByModesThatWereChosenGoesOnWithThem) {
  write("tap.yaml", R"(
mesh: {type: box, size: [1, 0.1, 0.1], cells: [10, 1, 1]}
materials: {m: {type: isotropic, density: 1000, young: 1e9, nu: 0.3}}
clamps: [{surface: x0}]
loads: [{surface: x1, force: [0, 0, -1]}]
elasticity: {kinematics: linear}
integrator: {type: auto, rtol: 1e-3}
time: {end: 1}
checkpoint: {every: 1000}
output: {probes: {tip: {at: [1, 0.05, 0.05]}}}
)");
  ASSERT_EQ(orthodyn("run tap.yaml --out part").exit_code, 0);
  ASSERT_EQ(record("part").at("integrator").at("method"), "modal");
  const auto longer = orthodyn("run tap.yaml --out part --resume --set time.end=2");
  ASSERT_EQ(longer.exit_code, 0) << longer.output;
  EXPECT_EQ(record("part").at("integrator").at("method"), "modal");
  ASSERT_EQ(orthodyn("run tap.yaml --out whole --set time.end=2").exit_code, 0);
  const auto a = read_rows(folder_ / "part/probes.csv").back(), b = read_rows(folder_ / "whole/probes.csv").back();
  EXPECT_NEAR(a.at(3), b.at(3), 1e-2 * std::abs(b.at(3)));
}

// `auto` computes position_scale and velocity_scale of a viscoelastic body from time.end. A resumed run with a later
// end must keep the scales of the first run.
TEST_F(Resume, ABodyThatSwellsAndRelaxesCanBeExtended) {
  write("bar.yaml", R"(
mesh: {type: box, size: [0.1, 0.01, 0.01], cells: [4, 1, 1], order: 1}
materials:
  m: {type: isotropic, density: 1000, young: 1e9, nu: 0, expansion: {moisture: 2e-4}, viscoelastic: [{time: 2, share: 0.5}]}
moisture: {change: -10, factor: {type: table, points: [[0, 0], [10, 1]]}}
clamps: [{surface: x0, components: [x], name: wall}, {surface: x1, components: [x]}, {nearest: [0, 0, 0], components: [y, z]},
         {nearest: [0, 0.01, 0], components: [z]}]
integrator: {rtol: 1e-6}
time: {end: 3}
checkpoint: {every: 1000}
output: {reactions: true, history: {interval: 0.5}}
)");
  ASSERT_EQ(orthodyn("run bar.yaml --quiet --out part").exit_code, 0);
  const auto longer = orthodyn("run bar.yaml --quiet --out part --resume --set time.end=8");
  ASSERT_EQ(longer.exit_code, 0) << longer.output;
  ASSERT_EQ(orthodyn("run bar.yaml --quiet --out whole --set time.end=8").exit_code, 0);
  const auto a = read_rows(folder_ / "part/probes.csv").back(), b = read_rows(folder_ / "whole/probes.csv").back();
  EXPECT_EQ(a.at(0), b.at(0));
  EXPECT_NEAR(a.at(1), b.at(1), 1e-4 * std::abs(b.at(1)));
}

TEST_F(Resume, ItDoesNotGoTogetherWithForce) {
  write("beam.yaml", kBeam + std::string(kBdf));
  EXPECT_EQ(orthodyn("run beam.yaml --resume --force").exit_code, 2);
  EXPECT_FALSE(fs::exists(folder_ / "out"));
}

}  // namespace
}  // namespace orthodyn::resume_test
