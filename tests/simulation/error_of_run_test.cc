// `orthodyn run --estimate-error`.
#include "tests/simulation/resume_fixture.h"

namespace orthodyn::error_of_run_test {
namespace {

TEST_F(Resume, TheErrorIsEstimatedOnRequestAndRecorded) {
  write("swing.yaml", kSwing);
  const auto result = orthodyn("run swing.yaml --estimate-error");
  ASSERT_EQ(result.exit_code, 0) << result.output;
  EXPECT_NE(result.output.find("integrator.rtol=0.0001"), std::string::npos) << result.output;
  EXPECT_NE(result.output.find("integration error of displacements: about"), std::string::npos) << result.output;
  const auto error = record("out/swing").at("estimated_error");
  EXPECT_EQ(error.at("samples"), 6);
  EXPECT_GT(error.at("displacement").at("largest"), 0);
  EXPECT_LT(error.at("displacement").at("largest"), 0.1);
}

TEST_F(Resume, AnEstimateThatCannotBeMadeIsRefusedBeforeTheEarlierResultIsTouched) {
  write("swing.yaml", kSwing);
  ASSERT_EQ(orthodyn("run swing.yaml --quiet").exit_code, 0);
  const auto result = orthodyn("run swing.yaml --quiet --force --estimate-error --set output.frames=0");
  EXPECT_EQ(result.exit_code, 2) << result.output;
  EXPECT_TRUE(fs::exists(folder_ / "out/swing/frames/frame_00005.vtu"));
}

}  // namespace
}  // namespace orthodyn::error_of_run_test
