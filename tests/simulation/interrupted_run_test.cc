// Runs that are interrupted, killed after the last step or stopped by a full disk, and resumed.
#include "tests/simulation/resume_fixture.h"

namespace orthodyn::interrupted_run_test {
namespace {

TEST_F(Resume, AnInterruptedRunGoesOnThoughItsSceneAsksForNoCheckpoints) {
  write("swing.yaml", kSwing);
  const std::string run = "run swing.yaml --quiet --set integrator.h_max=1e-5 --set time.end=";
  const auto stopped = shell("cd " + folder_.string() + " && { " + program() + " " + run +
                             "1e3 & pid=$!; for i in $(seq 200); do [ -s out/swing/steps.csv ] && break; sleep 0.05; "
                             "done; kill -TERM $pid; wait $pid; }");
  ASSERT_EQ(stopped.exit_code, 130) << stopped.output;
  const double reached = record("out/swing").at("time_reached");
  const auto result = orthodyn(run + std::to_string(reached + 0.001) + " --resume");
  EXPECT_EQ(result.exit_code, 0) << result.output;
  EXPECT_EQ(record("out/swing")["restarts"][0]["after"], "interrupted");
  EXPECT_EQ(record("out/swing")["restarts"][0]["time"], reached);
}

// A factorisation that would take minutes.
TEST_F(Resume, ATermSignalEndsALongFactorisationToo) {
  write("block.yaml", R"(
mesh: {type: box, size: [1, 1, 1], cells: [22, 22, 22], order: 1}
materials: {soft: {type: isotropic, density: 1000, young: 1e5, nu: 0.3}}
gravity: [0, 0, -1]
clamps: [{surface: x0}]
time: {end: 0.5}
integrator: {type: arkode_dirk, step: 0.01, position_scale: 0.1, velocity_scale: 0.1, linear_solver: eigen_ldlt}
)");
  const auto stopped = shell("cd " + folder_.string() + " && { " + program() +
                             " run block.yaml --quiet & pid=$!; for i in $(seq 600); do [ -e out/block/steps.csv ] && "
                             "break; sleep 0.05; done; sleep 1; kill -TERM $pid; for i in $(seq 60); do kill -0 $pid "
                             "2>/dev/null || break; sleep 0.5; done; kill -KILL $pid 2>/dev/null; wait $pid; }");
  EXPECT_EQ(stopped.exit_code, 130) << stopped.output;
  EXPECT_NE(stopped.output.find("in the middle of a computation"), std::string::npos) << stopped.output;
  EXPECT_EQ(record("out/block").at("status"), "running");
}

TEST_F(Resume, ARunKilledAfterItsLastStepGetsItsRecord) {
  write("beam.yaml", kBeam + std::string(kFixedStep));
  ASSERT_EQ(orthodyn("run beam.yaml --quiet --set time.end=0.1").exit_code, 0);
  const auto frames = read_text(folder_ / "out/beam/frames.pvd");
  write("out/beam/run.json", R"({"status": "running"})");
  ASSERT_EQ(orthodyn("run beam.yaml --quiet --resume --set time.end=0.1").exit_code, 0);
  EXPECT_EQ(record("out/beam").at("status"), "completed");
  EXPECT_EQ(record("out/beam").at("statistics").at("steps"), 5);
  EXPECT_EQ(read_text(folder_ / "out/beam/frames.pvd"), frames);
}

TEST_F(Resume, ARunThatFilledTheDiskGoesOnWhenThereIsRoom) {
  write("beam.yaml", kBeam + std::string(kFixedStep));
  // No file may exceed 8 kB: steps.csv does, in the middle of the run.
  const auto full = shell("cd " + folder_.string() + " && trap '' XFSZ; ulimit -f 16; " + program() +
                          " run beam.yaml --quiet --set output.fields=[region]");
  ASSERT_EQ(full.exit_code, 3) << full.output;
  EXPECT_NE(full.output.find("cannot write"), std::string::npos) << full.output;
  const auto result = orthodyn("run beam.yaml --quiet --resume --set output.fields=[region]");
  ASSERT_EQ(result.exit_code, 0) << result.output;
  EXPECT_EQ(read_rows(folder_ / "out/beam/steps.csv").size(), 200u);
  EXPECT_EQ(read_times(folder_ / "out/beam/frames.pvd").size(), 41u);
}

// A full disk of 1 MB, which only root can mount.
TEST_F(Resume, ARunThatFilledAWholeDiskGoesOnWhenThereIsRoom) {
  const std::string disk = (folder_ / "disk").string();
  fs::create_directories(disk);
  if (shell("mount -t tmpfs -o size=1m tmpfs " + disk + " 2>&1").exit_code != 0) GTEST_SKIP() << "no mount";
  write("swing.yaml", kSwing);
  const std::string run = "run swing.yaml --quiet --out disk/swing --set integrator.h_max=1e-5 --set output.frames=400";
  const auto full = orthodyn(run);
  const auto enlarged = shell("mount -o remount,size=64m " + disk);
  const auto result = orthodyn(run + " --resume");
  const bool completed = result.exit_code == 0 && record("disk/swing").at("status") == "completed";
  shell("umount " + disk);
  ASSERT_EQ(enlarged.exit_code, 0);
  EXPECT_EQ(full.exit_code, 3) << full.output;
  EXPECT_NE(full.output.find("No space left"), std::string::npos) << full.output;
  EXPECT_EQ(full.output.find("could not be saved"), std::string::npos) << full.output;
  EXPECT_TRUE(completed) << result.output;
}

TEST_F(Resume, ARunThatFilledTheDiskGoesOnThoughItsSceneAsksForNoCheckpoints) {
  write("swing.yaml", kSwing);
  // No file may exceed 24 kB: steps.csv does; run.json has reserved its space.
  const std::string run = "run swing.yaml --quiet --set integrator.h_max=2e-4 --set output.fields=[region]";
  const auto full = shell("cd " + folder_.string() + " && trap '' XFSZ; ulimit -f 48; " + program() + " " + run);
  ASSERT_EQ(full.exit_code, 3) << full.output;
  EXPECT_NE(full.output.find("cannot write"), std::string::npos) << full.output;
  EXPECT_NE(full.output.find("--resume"), std::string::npos) << full.output;
  const auto result = orthodyn(run + " --resume");
  ASSERT_EQ(result.exit_code, 0) << result.output;
  ASSERT_EQ(record("out/swing").at("status"), "completed");
  EXPECT_EQ(record("out/swing").at("restarts").size(), 1u);
  EXPECT_EQ(read_times(folder_ / "out/swing/frames.pvd").size(), 6u);
  EXPECT_EQ(record("out/swing").at("statistics").at("steps"), read_rows(folder_ / "out/swing/steps.csv").size());
}

}  // namespace
}  // namespace orthodyn::interrupted_run_test
