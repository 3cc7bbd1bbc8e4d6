// A million frames, rows, load steps or points require --yes; `check` estimates disk space and time before a run.
#include "lib/simulation/preflight/output_size.h"

#include "tests/simulation/run_program.h"

namespace orthodyn::output_size_test {
namespace {

class OutputSizeOf : public InFolder {
 protected:
  OutputSizeOf() { write("swing.yaml", kSwing); }

  void expect_refused(const std::string& arguments, const std::string& words) const {
    const auto result = orthodyn(arguments);
    EXPECT_EQ(result.exit_code, 2) << result.output;
    EXPECT_NE(result.output.find(words), std::string::npos) << result.output;
    EXPECT_NE(result.output.find("--yes"), std::string::npos) << result.output;
    EXPECT_FALSE(fs::exists(folder_ / "out/swing"));
  }
};

TEST_F(OutputSizeOf, AMillionFramesAreRefused) {
  expect_refused("run swing.yaml --set output.frames=1000000", "1000000 frames");
  expect_refused("run swing.yaml --set output.frames=null --set output.interval=1e-7", "5000000 frames");
}

TEST_F(OutputSizeOf, AMillionRowsAreRefused) {
  expect_refused("run swing.yaml --set output.history.interval=5e-7", "rows of tables");
}

// The number of steps is known for fixed steps only.
TEST_F(OutputSizeOf, ARowForEachOfAMillionFixedStepsIsRefused) {
  const std::string fixed =
      " swing.yaml --set 'integrator={type: generalized_alpha, step: 1e-7}' --set 'output.history={steps: true}'";
  expect_refused("run" + fixed, "5000000 rows of tables");
  const auto said = orthodyn("check" + fixed);
  EXPECT_NE(said.output.find("5000000 rows of tables of"), std::string::npos) << said.output;
  const auto adaptive = orthodyn("check swing.yaml --set 'output.history={steps: true}'");
  EXPECT_NE(adaptive.output.find("a row of tables of"), std::string::npos) << adaptive.output;
}

TEST_F(OutputSizeOf, AMillionLoadStepsAreRefused) {
  expect_refused(
      "run swing.yaml --set analysis=static --set integrator=null --set output.frames=null --set statics.max_step=1e-7 "
      "--set statics.first_step=1e-7 --set statics.min_step=1e-8 --set statics.max_steps=100000000",
      "load steps");
}

// The run starts, and ends at max_steps.
TEST_F(OutputSizeOf, YesHasThemAllTheSame) {
  const std::string run =
      "run swing.yaml --quiet --set output.frames=1000000 --set integrator.max_steps=3 --set integrator.h0=1e-10";
  EXPECT_EQ(orthodyn(run).exit_code, 2);
  EXPECT_EQ(orthodyn(run + " --yes").exit_code, 3);
}

TEST_F(OutputSizeOf, FewerAreNoQuestion) {
  EXPECT_EQ(orthodyn("run swing.yaml --quiet --set output.frames=null --set output.history.interval=1e-3").exit_code,
            0);
}

TEST_F(OutputSizeOf, CheckSaysSoToo) {
  const auto said = orthodyn("check swing.yaml --set output.frames=1000000");
  EXPECT_EQ(said.exit_code, 0) << said.output;
  EXPECT_NE(said.output.find("1000000 frames"), std::string::npos) << said.output;
  EXPECT_NE(said.output.find("--yes"), std::string::npos) << said.output;
}

TEST_F(OutputSizeOf, CheckTellsTimeAndDisk) {
  const auto said = orthodyn("check swing.yaml");
  for (const char* words : {"time, measured", "factorisation", "steps", "in all", "disk", "5 frames of"})
    EXPECT_NE(said.output.find(words), std::string::npos) << words << "\nin: " << said.output;
}

TEST_F(OutputSizeOf, CheckTellsThatOfEveryAnalysis) {
  for (const char* scene : {"column", "toggle", "pulled_strip"}) {
    const auto said = orthodyn(std::string("check " ORTHODYN_SOURCE_DIR "/configs/scenes/") + scene + ".yaml");
    EXPECT_EQ(said.exit_code, 0) << said.output;
    EXPECT_NE(said.output.find("in all"), std::string::npos) << said.output;
    EXPECT_EQ(said.output.find("days"), std::string::npos) << said.output;
  }
}

// Within a factor of two, on a mesh large enough to neglect the text around the numbers.
TEST_F(OutputSizeOf, FramesAreAsLargeAsWasSaid) {
  const char* const kFine = "mesh.cells=[16,8,8]";
  Config config = Config::from_file((folder_ / "swing.yaml").string());
  config.override_with(kFine);
  const OutputSize size = output_size_of(set_up(config));
  ASSERT_EQ(orthodyn(std::string("run swing.yaml --quiet --set time.end=1e-3 --set ") + kFine).exit_code, 0);
  const auto bytes = static_cast<double>(fs::file_size(folder_ / "out/swing/frames/frame_00001.vtu"));
  EXPECT_GT(size.frame_bytes, bytes / 2);
  EXPECT_LT(size.frame_bytes, bytes * 2);
}

TEST_F(OutputSizeOf, AMillionPointsAreRefused) {
  write("s.yaml", R"(scene: swing.yaml
vary:
  materials.soft.density: {from: 900, to: 1100, count: 1000}
  materials.soft.young: {from: 1e5, to: 2e5, count: 1000}
quantities: {far: {quantity: tip.displacement.z}}
)");
  const auto result = orthodyn("sweep s.yaml");
  EXPECT_EQ(result.exit_code, 2) << result.output;
  EXPECT_NE(result.output.find("1000000 points"), std::string::npos) << result.output;
}

// Both points cause the same warning.
TEST_F(OutputSizeOf, ASweepTellsOfASlipOnce) {
  write("s.yaml", R"(scene: {file: swing.yaml, set: {damping.stiffness: 1e4}}
vary: {materials.soft.density: [1000, 1100]}
quantities: {far: {quantity: tip.displacement.z}}
)");
  const auto result = orthodyn("sweep s.yaml --no-report");
  const auto first = result.output.find("creeps back without vibrating");
  EXPECT_NE(first, std::string::npos) << result.output;
  EXPECT_EQ(result.output.find("creeps back without vibrating", first + 1), std::string::npos) << result.output;
}

}  // namespace
}  // namespace orthodyn::output_size_test
