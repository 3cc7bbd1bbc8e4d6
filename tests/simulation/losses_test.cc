// No computed results are lost by signals, closed pipes, full disks, formulas without a value, or stopping events.
#include <fstream>

#include "lib/core/errors.h"
#include "lib/core/write_file.h"
#include "lib/simulation/output/json.h"
#include "tests/simulation/result_reader.h"
#include "tests/simulation/run_program.h"

namespace orthodyn::losses_test {
namespace {

class Losses : public InFolder {
 protected:
  Json record() const { return Json::parse(read_text(folder_ / "out/swing/run.json")); }

  // A long run; `action` is applied to it once it has written a few frames.
  CommandResult disturb(const std::string& action) const {
    return shell("cd " + folder_.string() + " && " + program() +
                 " run swing.yaml --quiet --set time.end=1e3 --set integrator.h_max=1e-3 --set output.interval=0.01 "
                 "--set output.frames=null & pid=$!; for i in $(seq 100); do [ -e " +
                 folder_.string() + "/out/swing/frames/frame_00003.vtu ] && break; sleep 0.1; done; " + action +
                 "; wait $pid");
  }
};

TEST_F(Losses, ATerminalThatCloses) {
  write("swing.yaml", kSwing);
  const auto result = disturb("kill -HUP $pid");
  EXPECT_EQ(result.exit_code, 130) << result.output;
  EXPECT_EQ(record()["status"], "interrupted");
  EXPECT_TRUE(fs::exists(folder_ / "out/swing/checkpoint.cbor"));
}

// METIS orders matrices of this size in most of the first seconds of the run, and reports the signal as an error of its
// own. A run that ended by itself was not ended by the signal.
TEST_F(Losses, ASignalWhileALargeMatrixIsOrdered) {
  write("large.yaml",
        "mesh: {type: box, size: [1, 0.4, 0.4], cells: [70, 28, 28], order: 1}\n"
        "materials: {m: {type: preset, name: sitka_spruce}}\nclamps: [{surface: x0}]\n"
        "gravity: [0, 0, -9.81]\ntime: {end: 1e-4}\nelasticity: {kinematics: corotational}\n");
  for (const char* seconds : {"0.3", "0.7", "1", "1.4"}) {
    const auto result =
        shell("cd " + folder_.string() + " && " + program() + " run large.yaml --quiet --force & pid=$!; sleep " +
              seconds + "; kill -TERM $pid; wait $pid");
    EXPECT_EQ(result.exit_code, 130) << seconds << result.output;
  }
}

TEST_F(Losses, AReaderOfTheSummaryThatLeaves) {
  write("swing.yaml", kSwing);
  const auto result = shell("cd " + folder_.string() + " && " + program() + " run swing.yaml 2>&1 | true");
  EXPECT_EQ(record()["status"], "completed") << result.output;
}

TEST_F(Losses, AFullDiskBehindTheStandardOutput) {
  for (const char* arguments : {"list solvers", "--help", "run --help", "--version"}) {
    const auto result = orthodyn(std::string(arguments) + " > /dev/full");
    EXPECT_EQ(result.exit_code, 3) << arguments << result.output;
    EXPECT_NE(result.output.find("No space left"), std::string::npos) << result.output;
  }
}

TEST_F(Losses, ADeviceStaysADevice) {
  EXPECT_THROW(write_file("/dev/full", {"text"}), RunError);
  EXPECT_TRUE(fs::is_character_file("/dev/full"));
  EXPECT_FALSE(fs::exists("/dev/full.part"));
}

// With two threads OpenBLAS waits forever for memory that it cannot have.
TEST_F(Losses, ALimitOfAddresses) {
#ifdef __SANITIZE_ADDRESS__
  GTEST_SKIP() << "the sanitizer itself takes more addresses";
#endif
  write("block.yaml", R"(
mesh: {type: box, size: [1, 0.2, 0.2], cells: [45, 9, 9], order: 1}
materials: {m: {type: isotropic, density: 1000, young: 1e6, nu: 0.3}}
clamps: [{surface: x0}]
gravity: [0, 0, -9.81]
time: {end: 1}
integrator: {type: cvode_bdf, max_steps: 2}
output: {fields: []}
)");
  const auto result =
      shell("cd " + folder_.string() + " && ulimit -v 600000 && OPENBLAS_NUM_THREADS=2 timeout -s KILL 120 " +
            program() + " run block.yaml --quiet");
  EXPECT_EQ(result.exit_code, 3) << result.output;  // max_steps, and not killed
  EXPECT_NE(result.output.find("max_steps"), std::string::npos) << result.output;
}

// Half a gigabyte, of which libraries and mesh take about two thirds. The factor is refused before it is tried, or,
// with libraries that take more, an allocation before it fails.
TEST_F(Losses, AFactorWithoutRoomEndsTheRunWithTheReason) {
#ifdef __SANITIZE_ADDRESS__
  GTEST_SKIP() << "needs all addresses";
#endif
  write("block.yaml", R"(
mesh: {type: box, size: [1, 1, 1], cells: [30, 30, 30], order: 1}
materials: {m: {type: isotropic, density: 1000, young: 1e6, nu: 0.3}}
clamps: [{surface: x0}]
gravity: [0, 0, -9.81]
time: {end: 1}
integrator: {type: arkode_dirk, step: 0.01, position_scale: 0.1, velocity_scale: 0.1}
output: {fields: []}
)");
  const auto result =
      shell("cd " + folder_.string() + " && ulimit -v 500000 && " + program() + " run block.yaml --quiet");
  EXPECT_EQ(result.exit_code, 3) << result.output;
  EXPECT_TRUE(result.output.find("the Cholesky factor does not fit in memory") != std::string::npos ||
              result.output.find("out of memory; use a coarser mesh") != std::string::npos)
      << result.output;
  EXPECT_EQ(Json::parse(read_text(folder_ / "out/block/run.json"))["failure"]["reason"], "out of memory");
}

TEST_F(Losses, AFormulaThatLosesItsValueOnTheWay) {
  write("swing.yaml",
        kSwing + std::string(
                     "loads: [{surface: x1, force: [0, 0, 1], factor: {type: expression, formula: sqrt(0.3-t)}}]\n"));
  const auto result = orthodyn("run swing.yaml --quiet");
  EXPECT_EQ(result.exit_code, 3) << result.output;
  EXPECT_NE(result.output.find("loads.0.factor.formula: 'sqrt(0.3-t)' is not a number at t = 0.3"), std::string::npos)
      << result.output;
  EXPECT_EQ(record()["status"], "failed");
  EXPECT_GT(read_rows(folder_ / "out/swing/energy.csv").size(), 2u);
  EXPECT_TRUE(fs::exists(folder_ / "out/swing/checkpoint.cbor"));
}

// Two events in one step, the first of which stops the run: the resumed run finds the second.
TEST_F(Losses, ARunThatAnEventStopsGoesOn) {
  const std::string events =
      "events:\n"
      "  - {quantity: tip.displacement.z, crosses: -0.02, action: stop}\n"
      "  - {quantity: tip.displacement.z, crosses: -0.0201}\n";
  write("swing.yaml", kSwing + events);
  ASSERT_EQ(orthodyn("run swing.yaml --quiet").exit_code, 0);
  EXPECT_EQ(record()["status"], "completed");
  const auto stopped = read_rows(folder_ / "out/swing/energy.csv");
  EXPECT_LT(stopped.back()[0], 0.5);
  const auto again = orthodyn("run swing.yaml --quiet --resume");
  ASSERT_EQ(again.exit_code, 0) << again.output;
  EXPECT_EQ(read_rows(folder_ / "out/swing/energy.csv").back()[0], 0.5);
  const std::string seen = read_text(folder_ / "out/swing/events.csv");
  EXPECT_NE(seen.find(",-0.02,down"), std::string::npos) << seen;
  EXPECT_NE(seen.find(",-0.0201,down"), std::string::npos) << seen;
}

TEST_F(Losses, ForceLeavesNothingOfAnEarlierResult) {
  write("swing.yaml", kSwing + std::string("events: [{quantity: tip.displacement.z, crosses: -0.001}]\n"));
  ASSERT_EQ(orthodyn("run swing.yaml --quiet").exit_code, 0);
  ASSERT_TRUE(fs::exists(folder_ / "out/swing/events.csv"));
  write("swing.yaml", kSwing);
  ASSERT_EQ(orthodyn("run swing.yaml --quiet --force").exit_code, 0);
  EXPECT_FALSE(fs::exists(folder_ / "out/swing/events.csv"));
}

}  // namespace
}  // namespace orthodyn::losses_test
