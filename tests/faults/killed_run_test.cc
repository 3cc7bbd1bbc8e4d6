// Runs killed at chosen writes and resumed from their checkpoints.
#include <csignal>
#include <random>

#include "tests/faults/faulty_program.h"

namespace orthodyn::killed_run_test {
namespace {

using Kind = WriteFaults::Kind;

class KilledRuns : public FaultyProgram {
 protected:
  // Kills the run at random writes, the `last` at most, until it completes. Returns the number of kills.
  int run_with_kills(const std::string& arguments, long last, std::mt19937& random) const {
    std::uniform_int_distribution<long> write(1, last);
    for (int kills = 0; kills < 100; ++kills) {
      const auto result = orthodyn_with_fault(Kind::killed, write(random), arguments);
      if (result.exit_code == 0) return kills;
      EXPECT_EQ(result.exit_code, 128 + SIGKILL) << result.output;
    }
    ADD_FAILURE() << "does not complete";
    return 100;
  }
};

struct Method {
  const char* name;
  const char* integrator;
  double tolerance;
};

class KilledRunsBy : public KilledRuns, public testing::WithParamInterface<Method> {};

TEST_P(KilledRunsBy, EndWithTheSameFrames) {
  const std::string history = "  history: {interval: 0.013}\n";  // of the section at the end of kBeam
  write("beam.yaml", kBeam + history + GetParam().integrator);
  // A checkpoint at each frame, so that progress does not depend on the speed of the machine.
  const std::string run = "run beam.yaml --quiet --set 'checkpoint={frames: 1}' --out ";
  const auto whole = orthodyn_with_fault(Kind::none, 0, run + "whole");
  ASSERT_EQ(whole.exit_code, 0) << whole.output;
  std::mt19937 random(7);
  for (const std::string out : {"once", "again"}) {
    EXPECT_GE(run_with_kills(run + out + " --resume", whole.writes / 2, random), 2) << out;
    EXPECT_LE(difference(folder_ / out, folder_ / "whole"), GetParam().tolerance) << out;
    expect_same_times(folder_ / out, folder_ / "whole");
    EXPECT_EQ(record(out).at("status"), "completed");
    for (const auto& entry : fs::recursive_directory_iterator(folder_ / out))
      EXPECT_NE(entry.path().extension(), ".part") << entry.path();
  }
}

// A restart of a multistep method costs some tolerances, as the whole run does. A fixed step repeats the same steps:
// the difference is due to the convergence of Newton's method.
INSTANTIATE_TEST_SUITE_P(Methods, KilledRunsBy,
                         testing::Values(Method{"bdf", kBdf, 10 * kRtol}, Method{"fixed_step", kFixedStep, 1e-6}),
                         [](const auto& info) { return info.param.name; });

}  // namespace
}  // namespace orthodyn::killed_run_test
